"""A package in which `colcon build` was run: it made its folders there."""

from __future__ import annotations

from collections.abc import Iterable

from grader.base.i18n.message import Message, say
from grader.base.shown import shown
from grader.package.intake.tree import join, parent


def built_inside(made: Iterable[str], root: str) -> Message | None:
    """Return the advice on colcon's folders inside of the package at `root`; None without any.

    `made` are the folders build and install of the submission. A build without install is not
    colcon's.
    """
    found = set(made)
    start = "" if root == "." else f"{root}/"
    for path in sorted(found):
        folder = parent(path)
        both = {join(folder, "build"), join(folder, "install")} <= found
        if both and path.startswith(start):
            inner = "" if folder == root else folder.removeprefix(start)
            place = f"{shown(inner)}/" if inner and inner != "." else ""
            return say(
                "colcon build was run inside the package: it made the folders build, install and "
                "log there. Delete them, in the package's folder: rm -r {place}build "
                "{place}install {place}log. Always build in the workspace: cd ~/ros2_ws && colcon "
                "build",
                place=place,
            )
    return None
