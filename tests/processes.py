"""Running commands in tests, also as an ordinary user or as a container's root."""

from __future__ import annotations

import contextlib
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Collection, Sequence
from pathlib import Path

from grader.base.cache import cache_root
from grader.ros.prefix import base_interpreter
from grader.sandbox.processes import stat_fields
from tests.command_server import commands

ROOT = Path(__file__).resolve().parent.parent
USER = 54_321
GONE_SECONDS = 20.0


def grader(*words: str | Path) -> list[str]:
    """Return the command line of this checkout's grader."""
    return [sys.executable, "-m", "grader", *map(str, words)]


def replaying(*words: str | Path) -> list[str]:
    """Return the command line of a grader that marks from recorded evidence (`recorded`)."""
    return [sys.executable, "-m", "tests.replaying", *map(str, words)]


def run(
    command: Sequence[str | Path],
    *,
    cwd: Path = ROOT,
    env: dict[str, str] | None = None,
    timeout: float = 120,
    stdin: str = "",
    forked: bool = True,
) -> subprocess.CompletedProcess[str]:
    """Run a command to its end and return it with its output.

    A command of this Python (`python -m …`) is forked from one that has made its imports, unless
    `forked` is false (see `command_server`).
    """
    words = [str(word) for word in command]
    environment = {**os.environ, "PYTHONPATH": str(ROOT), **(env or {})}
    if forked and words[:2] == [sys.executable, "-m"]:
        return commands().run(words[2:], cwd=cwd, env=environment, timeout=timeout, stdin=stdin)
    return subprocess.run(
        words,
        cwd=cwd,
        env=environment,
        input=stdin,
        capture_output=True,
        text=True,
        timeout=timeout,
        check=False,
    )


def _readable_by_all() -> list[str]:
    """Return the bwrap command for a view of this machine in which all users can read our Python.

    Root's Python may be in /root, which other users cannot read.
    """
    words = ["bwrap", "--dev-bind", "/", "/"]
    # the new /root hides only root's home, of which the needed folders are mounted again
    needed = {base_interpreter().parent.parent, Path(sys.prefix), cache_root()}
    inside = sorted(str(path) for path in needed if str(path).startswith("/root/"))
    words += ["--perms", "0755", "--tmpfs", "/root"]
    for folder in sorted({str(p) for path in inside for p in Path(path).parents if p != p.parent}):
        if folder.startswith("/root/"):
            words += ["--perms", "0755", "--dir", folder]
    for path in inside:
        words += ["--bind-try", path, path]
    return words


def as_user(command: Sequence[str]) -> list[str]:
    """Return a command that runs this one as an ordinary user, even if root runs the test."""
    if os.geteuid() != 0:
        return list(command)
    become = ["setpriv", f"--reuid={USER}", f"--regid={USER}", "--clear-groups"]
    become += ["--inh-caps=-all", "--bounding-set=-all", "--"]
    caps = [word for cap in ("SETUID", "SETGID", "SETPCAP") for word in ("--cap-add", f"CAP_{cap}")]
    return [*_readable_by_all(), *caps, "--", *become, *command]


def as_root_of_a_container(command: Sequence[str]) -> list[str]:
    """Return a command that runs this one like a container's root, with an empty /opt."""
    return [*_readable_by_all(), "--tmpfs", "/opt", "--cap-add", "ALL", "--", *command]


def alive(mark: str) -> list[str]:
    """Return the command lines of this machine's processes that contain `mark`."""
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit() and int(entry.name) != os.getpid():
            try:
                line = (
                    (entry / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
                )
            except OSError:
                continue
            if mark in line:
                found.append(line)
    return found


def wait_until_alive(mark: str) -> None:
    """Wait until a process has `mark` in its command line; fail if none gets it.

    While a process replaces its program, its command line is empty for a moment.
    """
    deadline = time.monotonic() + GONE_SECONDS
    while not alive(mark):
        assert time.monotonic() < deadline, mark
        time.sleep(0.02)


def wait_until_asleep(pid: int) -> None:
    """Wait until a process' first thread sleeps in the kernel, where every signal wakes it.

    Python checks for signals before it calls sleep, pause or read, and none of them returns for a
    signal that comes in between: on a busy machine Ctrl+C is lost there about once in 300 times.
    """
    while stat_fields(pid)[0] != "S":
        os.sched_yield()


def descendants(without: Collection[int] = ()) -> dict[int, str]:
    """Return the running descendants of this process with their command lines.

    The processes `without` and their descendants are left out: a browser that other tests keep open
    starts and ends processes at any time.
    """
    parents: dict[int, int] = {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                state, parent = stat_fields(int(entry.name))[:2]
            except OSError:
                continue
            if state != "Z" and int(entry.name) not in without:
                parents[int(entry.name)] = int(parent)
    found: dict[int, str] = {}
    todo = {os.getpid()}
    while todo:
        todo = {pid for pid, parent in parents.items() if parent in todo and pid not in found}
        for pid in todo:
            with contextlib.suppress(OSError):
                line = Path(f"/proc/{pid}/cmdline").read_bytes().replace(b"\0", b" ")
                found[pid] = line.decode(errors="replace")
    return found


def wait_until_gone(before: Collection[int]) -> None:
    """Wait until this process has no descendants other than `before`; fail if one stays."""
    deadline = time.monotonic() + GONE_SECONDS
    while left := descendants(without=before):
        assert time.monotonic() < deadline, left
        time.sleep(0.02)


def ends_as_bwrap_starts(folder: Path, name: str) -> dict[str, str]:
    """Return an environment in which bwrap first sends this signal to its parent."""
    program = folder / "bin" / "bwrap"
    program.parent.mkdir()
    program.write_text(f'#!/bin/sh\nkill -{name} $PPID\nexec "{shutil.which("bwrap")}" "$@"\n')
    program.chmod(0o755)
    return {"PATH": f"{program.parent}:{os.environ['PATH']}"}
