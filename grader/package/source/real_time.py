"""Whether a package's source reads a clock of real time, which does not follow `/clock`."""

from __future__ import annotations

import ast
from collections.abc import Sequence

from grader.package.intake.model import SourceFile
from grader.package.source.module import Module
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node_modules import node_modules

THROTTLE = "throttle_duration_sec"
OTHER_CLOCKS = {"STEADY_TIME", "SYSTEM_TIME"}
CLOCKS = {
    "clock_gettime",
    "monotonic",
    "monotonic_ns",
    "perf_counter",
    "perf_counter_ns",
    "time",
    "time_ns",
    "today",
    "utcnow",
}


def reads_real_time(files: Sequence[SourceFile]) -> bool:
    """Return whether a node's lines may depend on how fast ROS time runs.

    Its logger leaves out lines by real time (`throttle_duration_sec` of rclpy), or its code asks a
    clock of Python or another clock of ROS. Files that cannot be read count as not.
    """
    return any(
        _names(module) or any(_is_clock(name) for _, name in calls_in(module.tree))
        for module in node_modules(files)
    )


def _names(module: Module) -> bool:
    for node in module.nodes:
        if isinstance(node, ast.keyword) and node.arg == THROTTLE:
            return True
        if isinstance(node, ast.Attribute | ast.Name) and last_part(dotted(node)) in OTHER_CLOCKS:
            return True
    return False


def _is_clock(name: str) -> bool:
    return last_part(name) in CLOCKS or name in ("datetime.now", "datetime.datetime.now")
