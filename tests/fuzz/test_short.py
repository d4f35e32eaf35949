"""Short fuzzing of all that reads a student's bytes; `python -m tests.fuzz.deep` goes deeper.

Times are processor time, so the load of the machine does not matter.
"""

from __future__ import annotations

import re
import time
import tracemalloc
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from grader.package.edit.tree import Replace
from tests.corpus.broken import BROKEN
from tests.fuzz.targets import SEEDS, TARGETS

SECONDS = 10.0  # of processor time for one input; an ordinary one takes 0.01
MEGABYTES = 100  # beyond the size of the input
WORDS = (
    *(b"\r", b"\n", b"\r\n", b"\0", b"\t", b" ", b"'", b'"', b"'''", b"(", b")", b"[", b"]", b"{"),
    *(b"}", b",", b":", b"=", b"==", b"#", b"\\", b"%", b"$", b"&", b"<", b">", b"</", b"<!--"),
    *(b"f'", b"lambda: ", b"def f(self):\n", b"class A:\n", b"import os\n", b"self.", b"\xef\xbb\xbf"),
    *(b"\xff\xfe", b"\xf0\x9f\x8c\xb7", b"# coding: latin-1\n", b"# coding: utf-7\n", b"console_scripts"),
    *(b"<?xml version='1.0' encoding='latin-1'?>", b"<!DOCTYPE a>", b"]]>", b"<![CDATA[", b"[develop]"),
    *(b"\x1b[31m", b"\x1b]0;", b"Traceback (most recent call last):\n", b"Error: ", b"\xc3\xa9"),
)  # fmt: skip
BROKEN_PARTS = sorted(
    {e.new.encode() for p in BROKEN for e in p.edits if isinstance(e, Replace) and len(e.new) < 300}
)


@st.composite
def altered(draw: st.DrawFn, seed: bytes) -> bytes:
    """Draw a right file with parts of it removed, doubled or replaced."""
    found = seed
    for _ in range(draw(st.integers(0, 5))):
        start = draw(st.integers(0, len(found)))
        end = min(len(found), start + draw(st.integers(0, 40)))
        word = draw(
            st.one_of(
                st.sampled_from(WORDS),
                st.sampled_from(BROKEN_PARTS),
                st.binary(max_size=6),
                st.just(found[start:end] * 2),
            )
        )
        found = found[:start] + word + found[end:]
    return found


@pytest.mark.parametrize("name", TARGETS)
def test_no_crash_no_hang(name: str) -> None:
    @settings(max_examples=30, suppress_health_check=list(HealthCheck))
    @given(found=st.one_of(altered(SEEDS[name]), st.binary(max_size=200)))
    def run(found: bytes) -> None:
        begin = time.process_time()
        TARGETS[name](found)
        assert time.process_time() - begin < SECONDS

    run()


HOSTILE = {
    "deep brackets": b"(" * 5_000 + b")" * 5_000,
    "deep lists": b"x = " + b"[" * 90 + b"]" * 90,
    "long sum": b"x = " + b"'a' + " * 5_000 + b"'b'\n",
    "long line": b"a" * 99_000,
    "many lines": b"x=1\n" * 24_000,
    "many quotes": b"'" * 50_000,
    "many tags": b"<package>" + b"<a/>" * 10_000 + b"</package>",
    "deep tags": b"<a>" * 10_000,
    "entities": b"<!DOCTYPE a [<!ENTITY b 'cc'><!ENTITY d '&b;&b;&b;&b;'>]><package>&d;</package>",
    "comments": b"<!--" * 20_000,
    "sections": b"[a]\n" + b"b=1\n" * 1 + b"c = 2\n d\n" * 5_000,
    "setup with many entries": b"setup(entry_points={'console_scripts': ['a = b:c'" + b", 'a = b:c'"
    * 3_000 + b"]})\n",
    "setup with joined entries": b"setup(entry_points={'console_scripts': ['a = b:c'"
    + b" 'a = b:c'" * 3_000 + b"]})\n",
    "names of names": b"".join(b"a%d = a%d + a%d\n" % (n, n + 1, n + 1) for n in range(200)),
    "blanks": b" " * 90_000 + b"x",
    "log lines": b"[INFO] [1.1] [" + b"[" * 40_000,
    "escapes": b"\x1b[" * 20_000 + b"\x1b]" * 20_000,
    "errors": b"aError: " * 10_000 + b"\n" + b"A.b." * 20_000,
    "digits": b"[INFO] [" + b"1" * 90_000 + b".000000000] [a]: b",
    "not closed": re.sub(rb"\)", b"", SEEDS["python"]) * 20,
}  # fmt: skip


def slow(*marks: pytest.MarkDecorator) -> list[object]:
    """Every input with every reader: the first mark, and the last one for the slowest.

    The fixes try each of the many lines, which takes seconds.
    """
    return [
        pytest.param(
            kind, name, marks=marks[-1] if kind == "many lines" and "fix" in name else marks[:-1]
        )
        for kind in HOSTILE
        for name in TARGETS
    ]


@pytest.mark.parametrize(("kind", "name"), slow(pytest.mark.long))
def test_input_made_to_be_slow_or_large_takes_bounded_time_and_memory(kind: str, name: str) -> None:
    TARGETS[name](SEEDS[name])  # (modules loaded by the first call do not count)
    found = HOSTILE[kind]
    before = restarted_peak()
    begin = time.process_time()
    TARGETS[name](found)
    assert time.process_time() - begin < SECONDS
    assert peak() - before < MEGABYTES * 1_000_000


def test_the_peak_is_that_of_the_input() -> None:
    before = restarted_peak()
    assert len(b"x" * (MEGABYTES * 2_000_000)) == MEGABYTES * 2_000_000
    assert peak() - before > MEGABYTES * 1_000_000
    before = restarted_peak()
    assert peak() - before < MEGABYTES * 1_000_000


@pytest.mark.parametrize(("kind", "name"), slow(pytest.mark.long, pytest.mark.long))
def test_input_made_to_be_large_needs_little_memory(kind: str, name: str) -> None:
    """Count every allocation, which takes several times as long as the reading."""
    TARGETS[name](SEEDS[name])
    tracemalloc.start()
    try:
        TARGETS[name](HOSTILE[kind])
        assert tracemalloc.get_traced_memory()[1] < MEGABYTES * 1_000_000
    finally:
        tracemalloc.stop()


def restarted_peak() -> int:
    """Let the peak of this process' memory start at what it uses now; return that, in bytes."""
    Path("/proc/self/clear_refs").write_text("5")  # as in proc(5)
    return peak()


def peak() -> int:
    """Return the peak of this process' resident memory, in bytes."""
    status = Path("/proc/self/status").read_text()
    return int(re.findall(r"^VmHWM:\s+(\d+) kB$", status, re.MULTILINE)[0]) * 1024
