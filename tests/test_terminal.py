"""Reading lines from a terminal within the time limit, whatever is printed."""

from __future__ import annotations

import time

import pytest

from grader.run.terminal import Line, Terminal
from grader.sandbox.base import Console

RECORD = "[INFO] [1795226661.262229158] [my_first_node]: Hello time: 0"


class Endless(Console):
    """A console with endless output that never ends."""

    def __init__(self, piece: bytes) -> None:
        self._piece = piece

    def wait(self, seconds: float) -> bool:
        return True

    def read(self) -> bytes:
        time.sleep(0.001)
        return self._piece

    def interrupt(self) -> None:
        return

    def poll(self) -> tuple[int | None, int | None] | None:
        return None

    def end(self) -> None:
        return


@pytest.mark.parametrize("piece", [b".", b"x\n"])
def test_endless_output_extends_no_deadline(piece: bytes) -> None:
    terminal = Terminal(Endless(piece), most=5_000)  # (several seconds of output)
    begin = time.monotonic()
    lines = terminal.read()
    assert time.monotonic() - begin < 0.5
    assert bool(lines) == piece.endswith(b"\n")
    begin = terminal.run_clock.now()
    terminal.read(0.2)
    _, ended = terminal.finish(0.3)
    assert not ended
    assert terminal.run_clock.now() - begin < 1.5


def test_no_output_is_lost_between_two_reads() -> None:
    terminal = Terminal(Endless(b"ab\nc"), most=400_000)
    lines = [line.text for _ in range(4) for line in terminal.read(0.05)]
    assert lines[0] == "ab"
    assert set(lines[1:]) == {"cab"}
    assert terminal.transcript.count("ab") == len(lines)


def test_a_log_record_after_text_without_a_line_end_is_found() -> None:
    assert Line(RECORD, 1.0).parts() == [Line(RECORD, 1.0)]
    glued = Line(f"....{RECORD}", 1.0).parts()
    assert glued == [Line("....", 1.0), Line(RECORD, 1.0)]
    assert glued[1].log == (
        "INFO",
        1795226661262229158,
        "my_first_node",
        "Hello time: 0",
    )
    assert Line("100% [done]: well", 1.0).parts() == [Line("100% [done]: well", 1.0)]


def test_a_record_that_quotes_another_stays_one_record() -> None:
    line = Line(f"{RECORD} {RECORD}", 1.0)
    assert line.parts() == [line]
