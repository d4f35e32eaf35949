"""How many of this machine's cores have nothing to do: proc_stat(5)."""

from __future__ import annotations

import os
import time
from pathlib import Path

STAT = Path("/proc/stat")


class Idleness:
    """Tells how many cores were idle since it was last asked, once some time has passed."""

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds
        self._before = _idle_seconds()
        self._at = time.monotonic()

    def cores(self) -> float:
        """Return how many cores were idle on average; 0 where it was asked too soon to know."""
        passed = time.monotonic() - self._at
        if passed < self._seconds:
            return 0
        now = _idle_seconds()
        found = (now - self._before) / passed
        self.forget()
        return found

    def forget(self) -> None:
        """Begin anew: what was idle before no longer counts."""
        self._before, self._at = _idle_seconds(), time.monotonic()


def _idle_seconds() -> float:
    """Return the seconds for which cores were idle since the machine started, added up."""
    with STAT.open(encoding="ascii") as stream:
        fields = stream.readline().split()
    return (int(fields[4]) + int(fields[5])) / os.sysconf("SC_CLK_TCK")
