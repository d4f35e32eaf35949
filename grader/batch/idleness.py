"""Counts this machine's idle cores: proc_stat(5)."""

from __future__ import annotations

import os
import time
from pathlib import Path

STAT = Path("/proc/stat")


class Idleness:
    """Measures how many cores were idle, over intervals of at least `seconds`."""

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds
        self._before = _idle_seconds()
        self._at = time.monotonic()

    def cores(self) -> float:
        """Return how many cores were idle on average; 0 until the interval is long enough."""
        passed = time.monotonic() - self._at
        if passed < self._seconds:
            return 0
        now = _idle_seconds()
        found = (now - self._before) / passed
        self.restart()
        return found

    def restart(self) -> None:
        """Start a new interval."""
        self._before, self._at = _idle_seconds(), time.monotonic()


def _idle_seconds() -> float:
    """Return the idle time of all cores since the machine started, in seconds."""
    with STAT.open(encoding="ascii") as stream:
        fields = stream.readline().split()
    return (int(fields[4]) + int(fields[5])) / os.sysconf("SC_CLK_TCK")
