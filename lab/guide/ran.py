"""What is known of the student's runs: the last `ros2 run`, and one that Ctrl+Z has stopped.

The prompt of the lab keeps the last `ros2 run` of any terminal (`lab/shell/prompt.bash`).
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

FILE = ".lab/ran"
PROGRAM_RAN = "program_ran"
"""The condition that a program of ROS has run, kept with the package and the executable."""
MOST_BYTES = 20_000
ENDED_WELL = {0, 124, 129, 130, 137, 143, 148, 241, 254}
"""Exit statuses of a program that ended by itself or by a signal; ros2cli writes -2 as 254."""
LONG = 5.0  # seconds after which an error may be that of the end, after Ctrl+C
PROC = Path("/proc")


@dataclass(frozen=True)
class Ran:
    """A `ros2 run`: when it began and ended (seconds since the epoch), its exit status, the line."""

    started: float
    ended: float
    status: int
    command: str

    def is_of(self, package: str, executable: str) -> bool:
        """Whether it ran this executable."""
        words = rf"(?<!\S)ros2 run\s+{re.escape(package)}\s+{re.escape(executable)}(?![\w.-])"
        return re.search(words, self.command) is not None

    def crashed(self, *, may_fail_at_end: bool) -> bool:
        """Whether it ended with an error; one at its end is left out if it may fail there."""
        failed = self.status not in ENDED_WELL
        return failed and not (may_fail_at_end and self.ended - self.started >= LONG)


def last_run(workspace: Path) -> Ran | None:
    """Return the last `ros2 run` in a workspace; None if there was none or it is not known."""
    try:
        with (workspace / FILE).open("rb") as stream:
            text = stream.read(MOST_BYTES).decode("utf-8", "replace")
        started, ended, status, command = text.split("\t", 3)
        return Ran(int(started) / 1e6, int(ended) / 1e6, int(status), command.strip())
    except (OSError, ValueError):
        return None


def ended_well(workspace: Path, program: str) -> bool:
    """Whether the last `ros2 run` was of a program (package and executable), and did not crash."""
    ran = last_run(workspace)
    if ran is None or not ran.is_of(*program.split()):
        return False
    return not ran.crashed(may_fail_at_end=False)


def is_kept(workspace: Path) -> bool:
    """Whether a terminal of the lab keeps the runs of a workspace."""
    return (workspace / FILE).is_file()


def is_stopped(program: Path) -> bool:
    """Whether a process of this user runs a program and was stopped (Ctrl+Z)."""
    return any(_state(entry) == "T" for entry in _running(program))


def _running(program: Path) -> Iterator[Path]:
    try:
        entries = [entry for entry in PROC.iterdir() if entry.name.isdecimal()]
    except OSError:
        return
    wanted = {os.fsencode(program), os.fsencode(program.resolve())}
    for entry in entries:
        try:
            if entry.stat().st_uid == os.getuid():
                words = (entry / "cmdline").read_bytes().split(b"\0")
                if wanted.intersection(words):
                    yield entry
        except OSError:
            continue  # it has ended


def _state(entry: Path) -> str:
    """Return a process's state; proc(5): it stands behind the name, which is in brackets."""
    try:
        text = (entry / "stat").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""
    return text.rpartition(")")[2].split()[0]
