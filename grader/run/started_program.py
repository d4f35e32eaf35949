"""Which programs of the submission run, asked of the kernel (proc(5)), not of the student's processes.

`ros2 run` starts the file that the entry point leads to. Another program may run beside it, or in its
place. (With a Docker daemon on another machine the processes are not in sight: nothing is known.)
"""

from __future__ import annotations

import contextlib
import shlex
from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

from grader.sandbox.processes import stat_fields

MOST_WORDS = 4_000  # bytes of a command line that are read
FIRST_WORDS = 3  # of a command line, among which the script is: its interpreter may have an option
MOST_TOLD = 200  # characters of a command line


@dataclass(frozen=True)
class Seen:
    """What runs on a terminal: `own` is whether the file of the entry point is among it.

    `others` are the command lines of the programs that it, or anything in its place, started.
    """

    own: bool
    others: tuple[str, ...]


def programs(pids: Collection[int], *, package: str, executable: str) -> Seen | None:
    """Return what runs in these processes; None if they are not known."""
    known = {pid: found for pid in pids if (found := _process(pid)) is not None}
    if not known:
        return None
    place = f"/lib/{package}/{executable}"
    own = {
        pid
        for pid, (_, words) in known.items()
        if any(word.endswith(place) for word in words[:FIRST_WORDS])
    }
    above, todo = set[int](), set(own or _last(known))
    while todo:
        above |= todo
        todo = {known[pid][0] for pid in todo} & known.keys() - above
    lines = [shlex.join(words) for pid, (_, words) in known.items() if pid not in above | own]
    if not own:
        lines = [shlex.join(known[pid][1]) for pid in _last(known)] + lines
    return Seen(bool(own), tuple(dict.fromkeys(line[:MOST_TOLD] for line in lines)))


def _last(known: dict[int, tuple[int, list[str]]]) -> set[int]:
    """Return the processes without children."""
    return known.keys() - {parent for parent, _ in known.values()}


def _process(pid: int) -> tuple[int, list[str]] | None:
    """Return the parent and the words of a process' command line; None if it has ended."""
    with contextlib.suppress(OSError, ValueError):
        state, parent, *_ = stat_fields(pid)
        with Path(f"/proc/{pid}/cmdline").open("rb") as file:
            found = file.read(MOST_WORDS).decode("utf-8", errors="replace").split("\0")
        if state not in "ZX" and any(found):
            return int(parent), [word for word in found if word]
    return None
