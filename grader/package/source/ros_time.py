"""Whether a package's source waits for the node's clock by itself, and not by a timer."""

from __future__ import annotations

from collections.abc import Sequence

from grader.package.intake.model import SourceFile
from grader.package.source.names import calls_in, last_part
from grader.package.source.node_modules import node_modules

WAITS = ("sleep_for", "sleep_until", "now")
"""Methods of a clock of ROS that sleep by it, or tell its time to a loop that compares."""


def waits_for_ros_time(files: Sequence[SourceFile]) -> bool:
    """Return whether a loop of a node may wait for the node's clock.

    On `/clock` that time stands still for a node that never spins, since nothing takes the messages
    of `/clock`; on the wall clock it goes on. Files that cannot be read count as not.
    """
    return any(
        last_part(name) in WAITS
        for module in node_modules(files)
        for _, name in calls_in(module.tree)
    )
