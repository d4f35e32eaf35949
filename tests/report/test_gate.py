"""All terminal output passes the gate: no text from outside controls the terminal."""

from __future__ import annotations

import io
import re
import subprocess
import sys

import pexpect
import pytest

from grader.base.gate import Gate, behind, bytes_of, gate, gated_output
from grader.base.plain_text import LONGEST_LINE, MOST_LINES, bounded
from tests.report.pseudo_terminal import ROOT, environment, on_a_terminal
from tests.report.test_hostile import HOSTILE, forbidden_in

WAYS = {
    "print": 0,
    "write": 0,
    "echo": 0,
    "secho": 0,
    "warning": 0,
    "logging": 0,
    "error": 3,
    "usage": 2,
    "crash": 3,
    "console": 0,
    "page": 0,
}


def run(*ways: str, **more: str) -> str:
    """Return the output of the given ways, both streams together."""
    done = subprocess.run(
        [sys.executable, "-m", "tests.report.print_hostile", *ways],
        cwd=ROOT,
        env=environment(**more),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        timeout=60,
        check=False,
    )
    return done.stdout.decode()


def by_way(output: str) -> dict[str, str]:
    """Return the output of each way; fail if one has an unexpected exit status."""
    parts = re.split(r"\n== (\w+) (\d+)\n", output)
    found = dict(zip(parts[1::3], parts[0::3], strict=False))
    statuses = {way: int(status) for way, status in zip(parts[1::3], parts[2::3], strict=True)}
    assert statuses == WAYS, output
    return found


def test_a_pipe_gets_no_control_bytes_however_text_is_printed() -> None:
    output = run(*WAYS)
    assert "\x1b" not in output
    for way, text in by_way(output).items():
        assert "Score 100 / 100" in " ".join(text.split()), way
        assert forbidden_in(text) == set(), way


def test_a_terminal_gets_only_our_own_styles() -> None:
    terminal = on_a_terminal("print_hostile", *WAYS)
    terminal.expect(pexpect.EOF)
    ours = {"console": "\x1b[1m", "page": "\x1b[1m"}  # bold, but not the green from the text
    for way, text in by_way(str(terminal.before).replace("\r\n", "\n")).items():
        assert "Score 100 / 100" in " ".join(text.split()), way
        assert forbidden_in(text) == set(), way
        assert ("\x1b" in text) == (way in ours), way
        assert ours.get(way, "") in text, way
        assert "\x1b[32m" not in text, way


def test_an_encoding_that_lacks_the_characters_does_not_bypass_the_gate() -> None:
    output = run("echo", PYTHONIOENCODING="ascii", LANG="C")
    assert "== echo 0" in output
    assert forbidden_in(output) == set()


def test_a_grader_fault_has_a_traceback_and_its_own_status() -> None:
    output = run("crash")
    assert "== crash 3" in output
    assert "Traceback (most recent call last)" in output
    assert "please report it" in output


def test_a_very_long_error_is_cut() -> None:
    output = run("long")
    assert len(output) < 20_000
    assert "the end\n" in output
    assert "left out" in output


@pytest.mark.parametrize("name", HOSTILE)
def test_nothing_passes_but_visible_text(name: str) -> None:
    out = io.StringIO()
    print("before", HOSTILE[name], "after", file=gate(out))
    assert forbidden_in(out.getvalue()) == set()
    assert out.getvalue().startswith("before ")
    assert out.getvalue().endswith(" after\n")


def test_visible_text_passes_unchanged() -> None:
    text = "안녕하세요 … 😀\n\n  two lines\n"
    assert bounded(text) == text
    out = io.StringIO()
    for piece in ("a ", "b", "\n", "", "c\n"):
        gate(out).write(piece)
    assert out.getvalue() == "a b\nc\n"


def test_a_very_long_text_is_cut_in_the_middle() -> None:
    lines = bounded("x\n" * 1_000_000).split("\n")
    assert len(lines) <= MOST_LINES + 2
    assert len(bounded("x" * 10_000_000)) < LONGEST_LINE + 100


def test_a_gate_behaves_like_its_stream() -> None:
    raw = io.BytesIO()
    file = io.TextIOWrapper(raw, encoding="utf-8")
    made = gate(file)
    assert gate(made) is made
    assert behind(made) is file
    assert behind(file) is file
    assert bytes_of(made) is raw
    assert not made.isatty()
    assert not hasattr(made, "buffer"), "who finds one writes past the gate"
    with pytest.raises((TypeError, AttributeError)):
        made.write(b"")  # type: ignore[arg-type]  # click detects a text stream by this
    made.close()
    assert not file.closed


def test_the_streams_are_restored_afterwards() -> None:
    kept = sys.stdout, sys.stderr
    with gated_output():
        assert isinstance(sys.stdout, Gate)
        assert isinstance(sys.stderr, Gate)
    assert (sys.stdout, sys.stderr) == kept
