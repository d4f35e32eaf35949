"""A pseudo-terminal that runs `ros2 run`: its lines with their times, and Ctrl+C."""

from __future__ import annotations

import re
import time
from dataclasses import dataclass

from grader.sandbox.base import Console
from grader.sandbox.scheduling import RunClock

ANSI = re.compile(rb"\x1b(?:\[[0-?]*[ -/]*[@-~]|\][^\x07\x1b]*(?:\x07|\x1b\\)|[@-Z\\-_])")
LOG_LINE = re.compile(r"\[([A-Z]+)\] \[(\d+)\.(\d{9})\] \[([^\]]*)\]: (.*)")
LONGEST_LINE = 4_000  # characters; longer lines are cut
POLL_SECONDS = 0.002  # between two checks of a process that is ending
DRAIN_SECONDS = 0.05  # extra time in which a read takes data that has already come


@dataclass(frozen=True)
class Line:
    """One line of output; `wall` is when it was read (seconds since the epoch)."""

    text: str
    wall: float

    @property
    def log(self) -> tuple[str, int, str, str] | None:
        """Level, stamp (ns), logger and text, if the line looks like a log record."""
        match = LOG_LINE.fullmatch(self.text)
        if match is None:
            return None
        level, seconds, nanoseconds, name, text = match.groups()
        return level, int(seconds) * 1_000_000_000 + int(nanoseconds), name, text

    def parts(self) -> list[Line]:
        """Split a line in which text without a line end stands before a log record."""
        match = LOG_LINE.search(self.text)
        if match is None or match.start() == 0:
            return [self]
        at = match.start()
        return [Line(self.text[:at], self.wall), Line(self.text[at:], self.wall)]


class Terminal:
    """Reads a console, up to `most` bytes; its limits are on the run's clock."""

    def __init__(self, console: Console, *, most: int, run_clock: RunClock | None = None) -> None:
        self.run_clock = run_clock or RunClock()
        self.started = time.time()
        self._console = console
        self.most = most
        self._raw = bytearray()
        self._rest = b""
        self.ended = False
        self.flooded = False
        self.lines = 0  # that it has returned

    @property
    def raw(self) -> bytes:
        """All output read so far, as it came."""
        return bytes(self._raw)

    @property
    def transcript(self) -> str:
        """All output read so far, without control sequences."""
        return _clean(bytes(self._raw))

    def read(self, seconds: float = 0) -> list[Line]:
        """Return the lines that have come, waiting up to `seconds` for the first.

        Output without a line end does not extend that time.
        """
        deadline = time.monotonic() + max(0.0, seconds)
        lines: list[Line] = []
        left = seconds
        while not self.ended and not self.flooded and left > -DRAIN_SECONDS:
            if not self._console.wait(0 if lines else max(0.0, left)):
                break
            data = self._console.read()
            if not data:
                self.ended = True
                break
            data = data[: self.most - len(self._raw)]
            self._raw += data
            self.flooded = len(self._raw) >= self.most
            lines += self._split(data)
            left = deadline - time.monotonic()
        if self.ended and self._rest:
            lines += self._split(b"\n")
        self.lines += len(lines)
        return lines

    def _split(self, data: bytes) -> list[Line]:
        now = time.time()
        *whole, self._rest = (self._rest + data).split(b"\n")
        self._rest = self._rest[: LONGEST_LINE * 4]
        return [Line(_clean(line)[:LONGEST_LINE], now) for line in whole]

    def interrupt(self) -> None:
        """Press Ctrl+C."""
        try:
            self._console.interrupt()
        except OSError:
            self.ended = True

    def finish(self, seconds: float) -> tuple[list[Line], bool]:
        """Read until the command has ended; return the last lines and whether it ended in time."""
        limit = self.run_clock.limit(seconds)
        lines: list[Line] = []
        while not self.ended and not self.flooded:
            if limit.over:
                return lines, False
            lines += self.read(limit.slice)
        while self._console.poll() is None:
            if limit.over:
                return lines, False
            time.sleep(POLL_SECONDS)  # the terminal is closed: only the status is missing
        return lines, True

    @property
    def status(self) -> tuple[int | None, int | None]:
        """The exit status and the signal of the command; both None while it runs."""
        return self._console.poll() or (None, None)

    def processes(self) -> set[int]:
        """Return the ids of the command's processes; none if they are unknown."""
        return self._console.processes()

    def close(self) -> None:
        """End everything that still runs on it."""
        self._console.end()


def without_codes(text: str) -> str:
    """Return a text as a terminal shows it: without control sequences, as for colours."""
    return _clean(text.encode("utf-8", errors="replace"))


def _clean(data: bytes) -> str:
    text = ANSI.sub(b"", data).decode("utf-8", errors="replace")
    return text.replace("\r\n", "\n").rstrip("\r")
