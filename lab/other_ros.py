"""What to tell a student whose workspace was built for another ROS than the lab's.

`other_ros` is for what a command says: what is wrong, and the command that helps. Guide and doctor show
both in their own form, `say_other_ros` below what another command has printed.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from pathlib import Path

import click

from grader.base.i18n.message import say
from grader.report.notice import notice
from grader.ros.built_for import ROOT, change
from grader.ros.distro import DEFAULT

REBUILD = "cd ~/ros2_ws && rm -r build install log && colcon build --symlink-install"


def other_ros(workspace: Path, environment: Mapping[str, str]) -> tuple[str, str] | None:
    """Return what is wrong with a workspace's build and the command that helps; None if nothing.

    Nothing is known of it outside of a lab, where there is no ROS.
    """
    distro = environment.get("ROS_DISTRO") or DEFAULT
    found = change(workspace / "install", distro) if (ROOT / distro).is_dir() else None
    if found is None:
        return None
    if found.was != found.now or found.script is None:
        text = say(
            "your workspace was built for {was}, and this lab has {now}: ros2 run may not start your "
            "programs",
            was=str(found.was),
            now=str(found.now),
        )
    else:
        text = say(
            "{path} cannot start: its first line names {python}, which is not here",
            path=f"~/ros2_ws/{os.path.relpath(found.script, workspace)}",
            python=found.python,
        )
    return text, REBUILD


def say_other_ros(lang: str | None = None) -> None:
    """Write on stderr that the build of the lab's workspace is for another ROS, if it is."""
    from lab.guide.opened import opened_lab  # noqa: PLC0415 - keeps --help fast

    lab = opened_lab(lang)
    found = other_ros(lab.workspace, os.environ)
    if found is not None:
        notice(lab.translate(found[0]), sys.stderr)
        click.echo(f"→ {found[1]}", err=True)  # it is copied, so it is not wrapped
