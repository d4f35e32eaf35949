"""A pseudo-terminal with `ros2 run` on it, driven with pexpect: lines with their times, Ctrl+C."""

from __future__ import annotations

import contextlib
import os
import re
import select
import signal
import time
from collections.abc import Mapping
from collections.abc import Sequence
from dataclasses import dataclass

import pexpect

from grader.sandbox.base import kill_below

ANSI = re.compile(rb"\x1b(?:\[[0-?]*[ -/]*[@-~]|\][^\x07\x1b]*(?:\x07|\x1b\\)|[@-Z\\-_])")
LOG_LINE = re.compile(r"^\[([A-Z]+)\] \[(\d+)\.(\d{9})\] \[([^\]]*)\]: (.*)$")
LONGEST_LINE = 4_000  # characters; what a line has beyond them is left out
ROWS, COLUMNS = 40, 160
KILL_SECONDS = 5.0
POLL_SECONDS = 0.002  # between two looks at a process that is ending


@dataclass(frozen=True)
class Line:
    """One line of output: `wall` is when it was read (seconds of the epoch)."""

    text: str
    wall: float

    @property
    def log(self) -> tuple[str, int, str, str] | None:
        """Level, stamp (ns), logger and text, if the line looks like a log record."""
        match = LOG_LINE.match(self.text)
        if match is None:
            return None
        level, seconds, nanoseconds, name, text = match.groups()
        return level, int(seconds) * 1_000_000_000 + int(nanoseconds), name, text


class Terminal:
    """A command on a pseudo-terminal; what it prints is cut while it is read."""

    def __init__(self, command: Sequence[str], *, env: Mapping[str, str], most: int) -> None:
        self.started = time.time()
        self._spawn = pexpect.spawn(
            command[0],
            list(command[1:]),
            env=dict(env),
            timeout=None,
            dimensions=(ROWS, COLUMNS),
        )
        self._spawn.delayafterclose = self._spawn.delayafterterminate = 0
        self._spawn.ptyproc.delayafterclose = self._spawn.ptyproc.delayafterterminate = 0
        self._spawn.delaybeforesend = None
        self._most = most
        self._raw = bytearray()
        self._rest = b""
        self.ended = False
        self.flooded = False

    @property
    def fd(self) -> int:
        """The terminal's file descriptor, to wait on together with others."""
        return int(self._spawn.child_fd)

    @property
    def transcript(self) -> str:
        """Everything that was read so far, without control sequences."""
        return _clean(bytes(self._raw))

    def read(self, seconds: float = 0) -> list[Line]:
        """Return the lines that have come, waiting up to `seconds` for the first."""
        lines: list[Line] = []
        while not self.ended and not self.flooded:
            ready, _, _ = select.select([self.fd], [], [], 0 if lines else seconds)
            if not ready:
                break
            try:
                data = os.read(self.fd, 65536)
            except OSError:  # Linux says EIO when the last process has let go of the terminal
                data = b""
            if not data:
                self.ended = True
                break
            data = data[: self._most - len(self._raw)]
            self._raw += data
            self.flooded = len(self._raw) >= self._most
            lines += self._split(data)
        if self.ended and self._rest:
            lines += self._split(b"\n")
        return lines

    def _split(self, data: bytes) -> list[Line]:
        now = time.time()
        *whole, self._rest = (self._rest + data).split(b"\n")
        self._rest = self._rest[: LONGEST_LINE * 4]
        return [Line(_clean(line)[:LONGEST_LINE], now) for line in whole]

    def interrupt(self) -> None:
        """Press Ctrl+C."""
        try:
            self._spawn.sendintr()
        except OSError:
            self.ended = True

    def finish(self, seconds: float) -> tuple[list[Line], bool]:
        """Read until the command has ended; return the last lines, and whether it did in time."""
        deadline = time.monotonic() + seconds
        lines: list[Line] = []
        while not self.ended and not self.flooded:
            left = deadline - time.monotonic()
            if left <= 0:
                return lines, False
            lines += self.read(left)
        while time.monotonic() < deadline:
            if not self._spawn.isalive():
                return lines, True
            time.sleep(POLL_SECONDS)  # the terminal is shut already: only the status is to come
        return lines, not self._spawn.isalive()

    @property
    def status(self) -> tuple[int | None, int | None]:
        """Exit status and signal of the command; both None while it runs."""
        if self._spawn.isalive():
            return None, None
        return self._spawn.exitstatus, self._spawn.signalstatus

    def close(self) -> None:
        """End what still runs on it."""
        begin = time.monotonic()
        while self._spawn.isalive() and time.monotonic() < begin + KILL_SECONDS:
            if time.monotonic() < begin + KILL_SECONDS / 2:
                kill_below(self._spawn.pid)
            else:
                with contextlib.suppress(ProcessLookupError):
                    os.killpg(self._spawn.pid, signal.SIGKILL)
            time.sleep(POLL_SECONDS)
        self._spawn.close(force=False)


def _clean(data: bytes) -> str:
    text = ANSI.sub(b"", data).decode("utf-8", errors="replace")
    return text.replace("\r\n", "\n").rstrip("\r")
