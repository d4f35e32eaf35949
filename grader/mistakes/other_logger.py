"""Mistakes in which the lines go through a logger that is not the node's own."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import LOG_LINE, NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.imported import full_name
from grader.package.source.names import called_name, dotted, last_part
from grader.package.source.node import NodeSource

OWN = "self.get_logger()"
BY_NAME = "rclpy.logging.get_logger"


def _of_other_node(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only call that logs, with the logger of a second node that the node makes."""
    source = suspect.source
    logs = [log for part in source.own_methods for log in source.logs(part)]
    method = logs[0].func if len(logs) == 1 else None
    receiver = method.value if isinstance(method, ast.Attribute) else None
    if not isinstance(receiver, ast.Call) or called_name(receiver) != "get_logger":
        return None
    owner = dotted(receiver.func).rpartition(".")[0]
    made = [
        n
        for n in source.own_nodes
        if isinstance(n, ast.Assign)
        and owner in map(dotted, n.targets)
        and isinstance(n.value, ast.Call)
        and last_part(dotted(n.value.func)) in ("create_node", "Node")
    ]
    code = source.module_of(receiver).text.code(receiver)
    if len(made) != 1 or not _is_in_method(source, receiver) or receiver.args:
        return None
    found = suspect.finding("logger_of_other_node", receiver, name=code, written=OWN)
    values = {**found.words, "attribute": owner, "line": str(made[0].lineno)}
    return replace(found, words=values)


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
        "logger_of_other_node",
        "logger",
        msg("The line is logged with the logger of another node"),
        msg(
            "Each node has a logger with its own name. {attribute} is a second node (line {line}), so "
            "the lines that {name} logs have the name of that node."
        ),
        msg("Write {written} instead of {name}."),
        behind=dict.fromkeys(("run.wrong_node_name", "run.other_logger"), _of_other_node),
        fixed_by=(lines.written,),
        examples=(
            example(
                "logger_of_a_second_node",
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.counter_ = 0\n        self.second_ = rclpy.create_node('second')",
                ),
                Replace(NODE, LOG_LINE, LOG_LINE.replace("self.get", "self.second_.get")),
                fails="run.node_name",
            ),
        ),
    ),
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
