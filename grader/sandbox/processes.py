"""Processes of this machine by `/proc`: who descends from whom, and collecting what has ended.

Source: proc(5).
"""

from __future__ import annotations

import contextlib
import ctypes
import os
import signal
from collections.abc import Iterable, Iterator
from pathlib import Path

PR_SET_CHILD_SUBREAPER = 36


def adopt_orphans() -> None:
    """Have this process inherit the orphans of what it starts, so that they can be found."""
    ctypes.CDLL(None, use_errno=True).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)


def processes() -> Iterator[int]:
    """Yield the id of every process."""
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            yield int(entry.name)


def stat_fields(pid: int) -> list[str]:
    """Return the fields of a process' stat after its name: state, parent, group, session, …

    Raises OSError where it is gone.
    """
    return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()


def children_of(pid: int) -> list[int]:
    """Return the ids of what a process' first thread has started; OSError where it is gone."""
    return [int(word) for word in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


def descendants(root: int) -> set[int]:
    """Return the ids of the processes below one."""
    parents: dict[int, int] = {}
    for pid in processes():
        try:
            parents[pid] = int(stat_fields(pid)[1])
        except OSError:
            continue
    found: set[int] = set()
    todo = {root}
    while todo:
        todo = {pid for pid, parent in parents.items() if parent in todo and pid not in found}
        found |= todo
    return found


def reap(pids: Iterable[int]) -> None:
    """Collect those of these processes that have ended and are ours to collect."""
    for pid in pids:
        try:
            if stat_fields(pid)[0] == "Z":
                os.waitpid(pid, os.WNOHANG)
        except OSError:
            continue


def kill_with_children(pid: int) -> None:
    """Kill a process and its children; it is stopped first, so that it starts no other meanwhile.

    (A bwrap that is killed alone while it makes its namespaces leaves its other half waiting.)
    """
    with contextlib.suppress(OSError):
        os.kill(pid, signal.SIGSTOP)
        while stat_fields(pid)[0] not in "TtZX":
            os.sched_yield()
        for child in children_of(pid):
            with contextlib.suppress(OSError):
                os.kill(child, signal.SIGKILL)
    with contextlib.suppress(OSError):
        os.kill(pid, signal.SIGKILL)


def collect_orphans() -> None:
    """Collect the ended orphans of a PID namespace below ours that have become our children.

    (What this process has started itself is in its own namespace, and is left to `subprocess`.)
    """
    own = os.getpid()
    for pid in descendants(own):
        try:
            text = Path(f"/proc/{pid}/status").read_text()
            status = dict(line.split(":", 1) for line in text.splitlines() if ":" in line)
            ended = status["State"].strip().startswith("Z")
            if ended and int(status["PPid"]) == own and len(status["NSpid"].split()) > 1:
                os.waitpid(pid, os.WNOHANG)
        except (OSError, KeyError, ValueError):
            continue
