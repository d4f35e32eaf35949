"""Control groups: memory and process limits on a whole submission, if the system provides them.

Version 1 as root, version 2 if the grader's own group is delegated to it. Sources: the kernel's
documentation, admin-guide/cgroup-v1 and admin-guide/cgroup-v2.
"""

from __future__ import annotations

import contextlib
import os
import time
from dataclasses import dataclass, field
from pathlib import Path

from grader.sandbox.limits import Limits

ROOT = Path("/sys/fs/cgroup")
GROUP = "ros2_grader"


@dataclass
class Group:
    """A control group (in version 1 one folder per controller); `holds` names its limits."""

    folders: list[Path] = field(default_factory=list)
    holds: list[str] = field(default_factory=list)

    @property
    def entries(self) -> list[str]:
        """The files to which a process writes 0 to enter the group."""
        return [str(folder / "cgroup.procs") for folder in self.folders]

    def killed_for_memory(self) -> bool:
        """Whether the kernel killed a process of the group because memory ran out."""
        for folder in self.folders:
            for name in ("memory.oom_control", "memory.events"):
                for line in _read(folder / name).splitlines():
                    key, _, value = line.partition(" ")
                    if key == "oom_kill" and int(value) > 0:
                        return True
        return False

    def hit_process_limit(self) -> bool:
        """Whether the kernel refused to create a process in the group."""
        for folder in self.folders:
            for line in _read(folder / "pids.events").splitlines():
                key, _, value = line.partition(" ")
                if key == "max" and int(value) > 0:
                    return True
        return False

    def limit_hit(self) -> str:
        """Return the limit that the group hit, "" if none."""
        if self.killed_for_memory():
            return "memory"
        return "processes" if self.hit_process_limit() else ""

    def close(self) -> None:
        """Remove the group; its processes are already killed, but the kernel may need a moment."""
        for folder in self.folders:
            deadline = time.monotonic() + 5
            while folder.is_dir():
                try:
                    folder.rmdir()
                except OSError:
                    if time.monotonic() > deadline:
                        break
                    _kill(folder)
        self.folders.clear()


def open_group(limits: Limits, *, root: Path = ROOT) -> Group:
    """Create a control group with these limits; an empty one if the system allows none."""
    name = f"{os.getpid()}-{time.monotonic_ns()}"
    group = Group()
    if (root / "cgroup.controllers").is_file():
        _open_v2(group, limits, root, name)
    else:
        _open_v1(group, limits, root, name)
    return group


def _open_v1(group: Group, limits: Limits, root: Path, name: str) -> None:
    memory = int(limits.memory)
    for controller, limit, values in (
        (
            "memory",
            "memory",
            {"memory.limit_in_bytes": memory, "memory.memsw.limit_in_bytes": memory},
        ),
        ("pids", "processes", {"pids.max": int(limits.processes)}),
    ):
        folder = root / controller / GROUP / name
        if not (root / controller / "cgroup.procs").is_file():
            continue
        try:
            folder.mkdir(parents=True)
        except OSError:
            continue
        _remove_stale(folder.parent)
        if _set(folder, values):
            group.folders.append(folder)
            group.holds.append(limit)
        else:
            folder.rmdir()


def _remove_stale(parent: Path) -> None:
    """Remove the empty groups of killed graders; a group's name begins with the grader's PID."""
    for folder in parent.glob("[0-9]*-[0-9]*"):
        if not Path("/proc", folder.name.partition("-")[0]).exists():
            with contextlib.suppress(OSError):
                folder.rmdir()


def _open_v2(group: Group, limits: Limits, root: Path, name: str) -> None:
    own = _read(Path("/proc/self/cgroup")).strip().rpartition("::")[2].lstrip("/")
    parent = root / own
    have = set(_read(parent / "cgroup.subtree_control").split())
    values: dict[str, int] = {}
    if "memory" in have:
        values |= {"memory.max": int(limits.memory), "memory.swap.max": 0}
    if "pids" in have:
        values["pids.max"] = int(limits.processes)
    folder = parent / f"{GROUP}-{name}"
    try:
        if not values:
            return
        folder.mkdir()
    except OSError:
        return
    if _set(folder, values):
        group.folders.append(folder)
        group.holds += [n for n, c in (("memory", "memory"), ("processes", "pids")) if c in have]
    else:
        folder.rmdir()


def _set(folder: Path, values: dict[str, int]) -> bool:
    for file, value in values.items():
        if not (folder / file).exists():
            if file in ("memory.memsw.limit_in_bytes", "memory.swap.max"):
                continue  # the kernel does not account swap: there is nothing to limit
            return False
        try:
            (folder / file).write_text(str(value))
        except OSError:
            return False
    return True


def _kill(folder: Path) -> None:
    for pid in _read(folder / "cgroup.procs").split():
        with contextlib.suppress(OSError):
            os.kill(int(pid), 9)
    os.sched_yield()


def _read(path: Path) -> str:
    try:
        return path.read_text()
    except OSError:
        return ""
