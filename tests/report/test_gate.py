"""What goes to a terminal passes the gate: nothing from outside steers it, whatever prints it."""

from __future__ import annotations

import io
import subprocess
import sys

import pexpect
import pytest

from grader.base.gate import Gate, behind, bytes_of, gate, gated_output
from grader.base.plain_text import LONGEST_LINE, MOST_LINES, bounded
from tests.report.stage import ROOT, environment, on_a_terminal
from tests.report.test_hostile import HOSTILE, unfit

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


def run(way: str, **more: str) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(
        [sys.executable, "-m", "tests.report.misbehaving", way],
        cwd=ROOT,
        env=environment(**more),
        capture_output=True,
        timeout=60,
        check=False,
    )


@pytest.mark.parametrize("way", WAYS)
def test_in_a_pipe_there_is_no_control_byte_however_it_is_printed(way: str) -> None:
    done = run(way)
    said = done.stdout + done.stderr
    assert done.returncode == WAYS[way], said
    assert b"Score 100 / 100" in said
    assert unfit(said.decode()) == set()
    assert b"\x1b" not in said


@pytest.mark.parametrize("way", WAYS)
def test_on_a_terminal_there_are_our_own_styles_and_nothing_else(way: str) -> None:
    terminal = on_a_terminal("misbehaving", way)
    terminal.expect(pexpect.EOF)
    said = str(terminal.before).replace("\r\n", "\n")
    assert "Score 100 / 100" in said
    assert unfit(said) == set()
    ours = {"console": "\x1b[1m", "page": "\x1b[1m"}  # bold, and not the green that is in the text
    assert ("\x1b" in said) == (way in ours)
    assert ours.get(way, "") in said
    assert "\x1b[32m" not in said


def test_an_encoding_without_the_characters_opens_no_way_around() -> None:
    done = run("echo", PYTHONIOENCODING="ascii", LANG="C")
    assert done.returncode == 0, done.stderr
    assert unfit(done.stdout.decode("ascii")) == set()


def test_a_fault_of_ours_has_its_traceback_and_the_status_of_our_own_side() -> None:
    done = run("crash")
    assert done.returncode == 3
    assert b"Traceback (most recent call last)" in done.stderr
    assert b"please report it" in done.stderr


def test_an_error_without_end_is_cut() -> None:
    said = run("long").stderr.decode()
    assert len(said) < 20_000
    assert said.rstrip().endswith("the end")
    assert "left out" in said


@pytest.mark.parametrize("name", HOSTILE)
def test_nothing_passes_but_visible_text(name: str) -> None:
    out = io.StringIO()
    print("before", HOSTILE[name], "after", file=gate(out))
    assert unfit(out.getvalue()) == set()
    assert out.getvalue().startswith("before ")
    assert out.getvalue().endswith(" after\n")


def test_what_may_be_shown_passes_as_it_is() -> None:
    text = "안녕하세요 … 😀\n\n  two lines\n"
    assert bounded(text) == text
    out = io.StringIO()
    for piece in ("a ", "b", "\n", "", "c\n"):
        gate(out).write(piece)
    assert out.getvalue() == "a b\nc\n"


def test_a_text_without_end_is_cut_in_its_middle() -> None:
    lines = bounded("x\n" * 1_000_000).split("\n")
    assert len(lines) <= MOST_LINES + 2
    assert len(bounded("x" * 10_000_000)) < LONGEST_LINE + 100


def test_a_gate_stands_for_its_stream() -> None:
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
        made.write(b"")  # type: ignore[arg-type]  # click finds out so what it is
    made.close()
    assert not file.closed


def test_the_streams_are_back_afterwards() -> None:
    kept = sys.stdout, sys.stderr
    with gated_output():
        assert isinstance(sys.stdout, Gate)
        assert isinstance(sys.stderr, Gate)
    assert (sys.stdout, sys.stderr) == kept
