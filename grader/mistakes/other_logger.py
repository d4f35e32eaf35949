"""Mistakes in which the lines go through a logger that is not the node's own."""

from __future__ import annotations

import ast

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.imported import full_name
from grader.package.source.node import NodeSource

OWN = "self.get_logger()"
BY_NAME = "rclpy.logging.get_logger"


def _by_name(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only logger that the node gets by a name."""
    source = suspect.source
    found = [
        call for call, _ in source.calls if full_name(source.module_of(call), call.func) == BY_NAME
    ]
    if len(found) != 1 or not _is_in_method(source, found[0]):
        return None
    code = source.module_of(found[0]).text.code(found[0])
    return suspect.finding("logger_by_name", found[0], name=code, written=OWN)


def _is_in_method(source: NodeSource, call: ast.Call) -> bool:
    """Whether a call is in a method of the node that has self."""
    function = source.function_around(call)
    first = function.args.args[:1] if function in source.own_methods and function else []
    return [given.arg for given in first] == ["self"]


_node = Family("node", links.LOGGING)
KINDS = (
    _node(
        "logger_by_name",
        "logger",
        msg("The lines come from a logger that is not the node's"),
        msg(
            "rclpy.logging.get_logger gives a logger with the name that it gets. The node's own logger "
            "has the name of the node: get_logger() of the node returns it."
        ),
        msg("Write {written} instead of {name}."),
        behind={"run.other_logger": _by_name},
        fixed_by=(lines.written,),
        examples=(
            example(
                "logger_of_its_own",
                Replace(NODE, "import rclpy\nfrom", "import rclpy.logging\nimport rclpy\nfrom"),
                Replace(
                    NODE, "self.get_logger().info", "rclpy.logging.get_logger('my_logger').info"
                ),
                fails="run.logger",
            ),
        ),
    ),
)
