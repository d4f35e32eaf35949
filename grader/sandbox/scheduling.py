"""How long processes waited for a core, by the kernel's scheduling statistics.

What a callback takes beyond that, it ran or slept: that is its own, whatever the load. Source: the
kernel's documentation, scheduler/sched-stats ("/proc/<pid>/schedstat": nanoseconds on a core,
nanoseconds waiting on a run queue, time slices).
"""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

SECOND = 1_000_000_000


def seconds_waited(pids: Collection[int]) -> float:
    """Return the seconds that the threads of these processes have waited for a core, in sum.

    Threads wait side by side, so this is at least as long as any of them was held up. Processes
    that have ended count no more.
    """
    return sum(_waited(pid) for pid in pids) / SECOND


def _waited(pid: int) -> int:
    total = 0
    try:
        threads = list(Path(f"/proc/{pid}/task").iterdir())
    except OSError:
        return 0
    for thread in threads:
        try:
            words = (thread / "schedstat").read_text().split()
            total += int(words[1])
        except (OSError, IndexError, ValueError):
            continue
    return total
