"""Packages of the corpus as tasks for a pool, and the ids of its workers."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from grader.batch.work import Job, Task
from grader.sandbox.limits import Limits
from grader.sandbox.processes import stat_fields
from tests.corpus.broken import BROKEN
from tests.corpus.build import write
from tests.corpus.model import Package
from tests.corpus.right import RIGHT
from tests.marking import ASSIGNMENT, taken_in

JOB = Job(ASSIGNMENT, "jazzy", "bubblewrap", Limits())
CORPUS: dict[str, Package] = {package.name: package for package in (*RIGHT, *BROKEN)}


def package(name: str, folder: Path, *, called: str = "") -> Path:
    """Write a package of the corpus to `folder/<called>/my_robot_controller`."""
    place = folder / (called or name)
    place.mkdir(parents=True)
    write(CORPUS[name], place).rename(place / "my_robot_controller")
    return place


FLAGS, PF_EXITING = 6, 0x4
"""The place of a process' flags in its stat, and the one of a process that ends (linux/sched.h)."""


def tasks(folder: Path, names: Sequence[str]) -> Iterator[Task]:
    """Yield a task for each name; the student's name is the package's and its number."""
    for number, name in enumerate(names):
        student = f"{name}-{number}"
        place = package(name, folder, called=student)
        submission = taken_in(place)
        yield Task(student, student, str(number), f"key-{number}", submission)


def workers_of(parent: int) -> list[int]:
    """Return the process ids of the workers that a process has started."""
    found = []
    for entry in Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            if int(stat_fields(int(entry.name))[1]) != parent:
                continue
            command = _command_line(int(entry.name))
        except OSError:
            continue
        if b"grader.batch.worker" in command:
            found.append(int(entry.name))
    return sorted(found)


def _command_line(pid: int) -> bytes:
    """Return a process' command line, also of a process that Popen started just now.

    Popen returns as soon as the new program closes its inherited files. The kernel sets the command
    line only after that, and until then it is empty. It is also empty while the process ends, which
    may wait for a child of ours.
    """
    path = Path(f"/proc/{pid}/cmdline")
    while not (command := path.read_bytes()) and not int(stat_fields(pid)[FLAGS]) & PF_EXITING:
        os.sched_yield()
    return command


def own_workers() -> list[int]:
    """Return the process ids of this process' workers."""
    return workers_of(os.getpid())
