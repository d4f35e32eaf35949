"""Control groups: memory and process limits on a whole submission, if the system provides them.

Version 1 as root. Version 2 in a group of the grader's own: in one that holds nothing but the
grader, or in a new one that systemd delegates. The kernel gives controllers only to the children of
a group without processes (EBUSY otherwise), so the grader's own processes move to a leaf of it.

Sources: the kernel's documentation, admin-guide/cgroup-v1 and admin-guide/cgroup-v2 ("No Internal
Process Constraint"); systemd's CGROUP_DELEGATION and org.freedesktop.systemd1(5).
"""

from __future__ import annotations

import contextlib
import errno
import os
import shutil
import subprocess
import time
from collections.abc import Collection
from dataclasses import dataclass, field
from pathlib import Path

from grader.sandbox.limits import Limits
from grader.sandbox.processes import descendants

ROOT = Path("/sys/fs/cgroup")
GROUP = "ros2_grader"
LEAF = f"{GROUP}-own"  # of the grader's own processes, beside the submissions' groups
SYSTEMD = Path("/run/systemd/system")  # is there if systemd runs the machine: sd_booted(3)
SYSTEMD_SECONDS = 5.0
POLL_SECONDS = 0.02


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


def _remove_stale(parent: Path, prefix: str = "") -> None:
    """Remove the empty groups of killed graders; after `prefix`, a name has the grader's PID."""
    for folder in parent.glob(f"{prefix}[0-9]*-[0-9]*"):
        if not Path("/proc", folder.name.removeprefix(prefix).partition("-")[0]).exists():
            with contextlib.suppress(OSError):
                folder.rmdir()


def _open_v2(group: Group, limits: Limits, root: Path, name: str) -> None:
    parent = delegated_group(root, ("memory", "pids"))
    have = _words(parent / "cgroup.subtree_control")
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
    _remove_stale(parent, f"{GROUP}-")
    if _set(folder, values):
        group.folders.append(folder)
        group.holds += [n for n, c in (("memory", "memory"), ("processes", "pids")) if c in have]
    else:
        folder.rmdir()


def delegated_group(root: Path, controllers: Collection[str]) -> Path:
    """Return the version 2 group below which groups with these controllers can be made.

    Makes one if that is possible. If not, its `cgroup.subtree_control` lacks some of them.
    """
    group = _own_group(root)
    if _enable(group, controllers) or not _move_to_own_scope(root):
        return group
    group = _own_group(root)
    _enable(group, controllers)
    return group


def _own_group(root: Path) -> Path:
    rows = _read(Path("/proc/self/cgroup")).splitlines()
    path = next((row.removeprefix("0::") for row in rows if row.startswith("0::")), "/")
    group = root / path.lstrip("/")
    return group.parent if group.name == LEAF else group


def _enable(group: Path, controllers: Collection[str]) -> bool:
    """Give the group's children these controllers; return whether they have them.

    If our processes prevent it, and only ours, they move to a leaf of the group.
    """
    wanted = _words(group / "cgroup.controllers") & set(controllers)
    missing = wanted - _words(group / "cgroup.subtree_control")
    words = " ".join(f"+{name}" for name in sorted(missing))
    for attempt in range(2):
        try:
            if missing:
                (group / "cgroup.subtree_control").write_text(words)
            return wanted == set(controllers)
        except OSError as error:
            if attempt or error.errno != errno.EBUSY or not _move_to_leaf(group):
                return False
    return False


def _move_to_leaf(group: Path) -> bool:
    """Move the group's processes to a leaf; return whether all were ours, and are there."""
    here = {int(word) for word in _words(group / "cgroup.procs")}
    if not here <= {os.getpid(), *descendants(os.getpid())}:
        return False
    leaf = group / LEAF
    try:
        leaf.mkdir(exist_ok=True)
        for pid in here:
            with contextlib.suppress(ProcessLookupError):
                (leaf / "cgroup.procs").write_text(str(pid))
    except OSError:
        return False
    return True


def _move_to_own_scope(root: Path) -> bool:
    """Ask systemd for a delegated scope with this process; return whether it is in one."""
    program = shutil.which("busctl")
    if program is None or not SYSTEMD.is_dir():
        return False
    before = _own_group(root)
    name = f"{GROUP}-{os.getpid()}.scope"
    command = [program, *([] if os.geteuid() == 0 else ["--user"]), "call"]
    command += ["org.freedesktop.systemd1", "/org/freedesktop/systemd1"]
    command += ["org.freedesktop.systemd1.Manager", "StartTransientUnit", "ssa(sv)a(sa(sv))"]
    command += [name, "fail", "2", "PIDs", "au", "1", str(os.getpid()), "Delegate", "b", "true"]
    deadline = time.monotonic() + SYSTEMD_SECONDS
    try:
        quiet = subprocess.DEVNULL
        done = subprocess.run(
            [*command, "0"], stdout=quiet, stderr=quiet, timeout=SYSTEMD_SECONDS, check=False
        )
    except (OSError, subprocess.TimeoutExpired):
        return False
    while done.returncode == 0 and time.monotonic() < deadline:
        if _own_group(root) != before:
            return True
        time.sleep(POLL_SECONDS)  # systemd moves the process after it has answered
    return False


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


def _words(path: Path) -> set[str]:
    return set(_read(path).split())


def _read(path: Path) -> str:
    try:
        return path.read_text()
    except OSError:
        return ""
