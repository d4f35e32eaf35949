"""Helpers for tests with an open lab."""

from __future__ import annotations

import contextlib
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

from grader.sandbox.processes import stat_fields
from tests import processes
from tests.lab.kinds import Kind
from tests.lab.screen import Lab, command, environment

SLOW = 90  # seconds


def run(
    kind: Kind, workspace: Path, *words: str, stdin: str = ""
) -> subprocess.CompletedProcess[str]:
    """Run a command in the lab without a terminal."""
    line = command("--sandbox", kind.sandbox, "--workspace", workspace, *words)
    return processes.run(line, env=environment(**kind.env), stdin=stdin, timeout=SLOW)


def start(lab: Lab, mark: str) -> None:
    """Start a command in the foreground and wait until it has the terminal."""
    lab.screen.sendline(f"sh -c 'echo up; exec {mark}'")
    lab.screen.expect("\nup")


def alive(mark: str) -> list[str]:
    """Return the running programs with this command line, in any lab."""
    return [line for line in processes.alive(mark) if line.startswith(mark)]


def has_the_terminal(mark: str) -> bool:
    """Return whether a program with this command line sleeps in its terminal's foreground."""
    for entry in Path("/proc").iterdir():
        with contextlib.suppress(OSError, ValueError):
            line = (entry / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
            # proc(5): after the name come state, parent, group, session, terminal, foreground group
            state, _, group, _, _, foreground = stat_fields(int(entry.name))[:6]
            if line.startswith(mark) and state == "S" and group == foreground:
                return True
    return False


def until(condition: Callable[[], bool]) -> None:
    """Wait until a condition outside this process holds; fail after SLOW seconds."""
    deadline = time.monotonic() + SLOW
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.02)
