"""Reads `/proc` for the descendants of a process and reaps processes that have ended.

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
    """Make this process the parent of its descendants' orphans, so that it can find them."""
    ctypes.CDLL(None, use_errno=True).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)


def processes() -> Iterator[int]:
    """Yield the id of every process."""
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            yield int(entry.name)


def stat_fields(pid: int) -> list[str]:
    """Return the fields of /proc/PID/stat after the name: state, parent, group, session, …

    Raises OSError if the process has ended.
    """
    return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()


def children_of(pid: int) -> list[int]:
    """Return the children of a process' first thread; OSError if the process has ended."""
    return [int(word) for word in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


def descendants(root: int) -> set[int]:
    """Return the ids of all descendants of a process."""
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
    """Reap those of these processes that have ended and are children of this one."""
    for pid in pids:
        try:
            if stat_fields(pid)[0] == "Z":
                os.waitpid(pid, os.WNOHANG)
        except OSError:
            continue


def kill_with_children(pid: int) -> None:
    """Kill a process and its children; stop it first so that it cannot start more of them.

    (Killing only the outer bwrap while it sets up namespaces leaves the inner one waiting.)
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
    """Reap ended orphans from PID namespaces below ours that have become our children.

    (Processes that this one started itself are in its own namespace; `subprocess` reaps them.)
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
