"""The peak memory of a process."""

from __future__ import annotations

from pathlib import Path


def peak_memory() -> float:
    """Return the peak resident memory of this process since it began its program, in MB.

    `ru_maxrss` is not that peak: a process inherits it from the process that starts it, so a
    small command of a large test run has the size of the test run.
    """
    for line in Path("/proc/self/status").read_text(encoding="ascii").splitlines():
        if line.startswith("VmHWM:"):
            return int(line.split()[1]) * 1024 / 1e6
    raise AssertionError("this kernel tells no VmHWM")
