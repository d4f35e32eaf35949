"""The mistake of a finished node in another file than the one that is started (`grader.verdict`)."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import INNER, NODE, SILENT, example
from grader.mistakes.fixes.case import Case
from grader.mistakes.imports import HELLO_CLASS
from grader.mistakes.kind import Family
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace, Write

TIMER = "        self.create_timer(1.0, self.timer_callback)\n"
FINISHED = f"""\
import rclpy
{HELLO_CLASS}

def main(args=None):
    rclpy.init(args=args)
    node = MyFirstNode()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    rclpy.try_shutdown()
"""


def copied(case: Case) -> Files | None:
    """Copy the finished file over the one that is started."""
    there = case.files.data(str(case.finding.params.get("there", "")))
    if there is None or not there.startswith(b"#!"):
        return None  # (the file that is started needs a first line too)
    return case.with_data(case.finding.file, there)


_node = Family("node", links.PACKAGE)
KINDS = (
    _node(
        "finished_elsewhere",
        "timer",
        msg("The finished node is in another file"),
        msg(
            "ros2 run starts {path}, which has no timer. A node with a timer that logs is in "
            "{there}, and nothing starts that file."
        ),
        msg(
            "Copy the code of {there} into {path}, then delete {there}. To copy it, run in the "
            "package's folder: cp {there} {path}"
        ),
        fixed_by=(copied,),
        examples=(
            example(
                "finished_in_copy",
                Replace(NODE, TIMER, "        self.get_logger().info('Hello ROS2')\n"),
                Write(f"{INNER}/my_first_node_final.py", f"#!/usr/bin/env python3\n{FINISHED}"),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
)
