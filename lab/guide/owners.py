"""Files of the workspace that belong to another user: a build or an editor that ran as root."""

from __future__ import annotations

import os
import shlex
from collections.abc import Iterator
from itertools import islice
from pathlib import Path

from grader.base.i18n.message import say
from grader.base.shown import shown
from lab.guide.action import Action
from lab.guide.state import StudentState

MOST_FILES = 500  # that are looked at
OWNER = "workspace.owner"
OUTSIDE = "LAB_WORKSPACE"  # the workspace's path on the student's machine


def not_yours(state: StudentState) -> Action | None:
    """Return the action for a file of the workspace that the student may not change."""
    if os.getuid() == 0:
        return None
    for path in islice(_files(state), MOST_FILES):
        try:
            owner = path.lstat().st_uid
        except OSError:
            continue
        if owner == os.getuid() or path.is_symlink() or os.access(path, os.W_OK):
            continue
        name = shown(f"~/ros2_ws/{path.relative_to(state.workspace)}")
        place = state.environment.get(OUTSIDE, "")
        command = f'sudo chown -R "$USER" {shlex.quote(place) if place else "~/ros2_ws"}'
        return Action(
            say("Outside of the lab, run: {command}", command=command),
            OWNER,
            say("{path} belongs to another user, so you may not change it", path=name),
            (say("A build or an editor with sudo leaves files that belong to root."),),
            where=say("In a terminal of your machine, outside of the lab."),
        )
    return None


def _files(state: StudentState) -> Iterator[Path]:
    """Yield the folders of the workspace, those of the package's build, and the package's files."""
    name = state.assignment.package
    for folder in ("src", "build", "install", "log", f"build/{name}", f"install/{name}"):
        if (state.workspace / folder).exists():
            yield state.workspace / folder
    yield from state.package.rglob("*")
