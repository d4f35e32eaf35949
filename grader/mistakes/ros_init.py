"""Mistakes with which a node does not start: rclpy.init()."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines, node_life
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.names import dotted, last_part

NOT_INITIALIZED = r"NotInitializedException"
NODES_MADE = msg("rclpy.init() connects the program to ROS; no node can be created before it.")


def _inits(raised: Raised) -> list[ast.Call]:
    return [call for call, name in raised.source.calls if last_part(name) == "init"]


def _init_missing(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    if _inits(raised):
        return None
    for node in raised.source.all_nodes:
        if isinstance(node, ast.Expr) and dotted(node.value) == "rclpy.init":
            return replace(raised.finding("init_missing", at=node), variant="not_called")
    return raised.finding("init_missing")


def _init_late(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    return raised.finding("init_late") if _inits(raised) else None


def _init_twice(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    del match
    inits = [call for call, name in raised.source.calls if name == "rclpy.init"]
    return raised.finding("init_twice", at=inits[1] if len(inits) > 1 else None)


def _without_keyword(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The call of init on the line has a value that is not given by its name."""
    del match
    for call, name in raised.source.calls:
        if last_part(name) == "init" and len(call.args) == 1 and raised.line == call.lineno:
            text = raised.source.module_of(call).text
            function, given = text.code(call.func), text.code(call.args[0])
            written = f"{function}(args={given})"
            return raised.finding("init_arguments", at=call, name=text.code(call), written=written)
    return None


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "init_missing",
        "start",
        msg("rclpy.init() is not called"),
        NODES_MADE,
        msg("Write rclpy.init(args=args) as the first line of {function}."),
        links.RCLPY,
        fixes={"not_called": msg("Write () after rclpy.init: without them it is not called.")},
        seen=r"NotInitializedException",
        raised={NOT_INITIALIZED: _init_missing},
        fixed_by=(node_life.called_init, node_life.rclpy_init),
        examples=(
            example(
                "rclpy_init_not_called",
                Replace(NODE, "rclpy.init(args=args)", "rclpy.init"),
                fails="run.starts",
            ),
            example(
                "rclpy_init_missing",
                Replace(NODE, "    rclpy.init(args=args)\n", ""),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "init_late",
        "start",
        msg("rclpy.init() is called after the node is created"),
        NODES_MADE,
        msg("Move rclpy.init(args=args) to the first line of {function}."),
        links.RCLPY,
        raised={NOT_INITIALIZED: _init_late},
        fixed_by=(node_life.rclpy_init,),
        examples=(
            example(
                "rclpy_init_after_node",
                Replace(
                    NODE,
                    "    rclpy.init(args=args)\n    node = MyFirstNode()\n",
                    "    node = MyFirstNode()\n    rclpy.init(args=args)\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "init_arguments",
        "start",
        msg("rclpy.init() gets its arguments without their name"),
        msg("rclpy.init() takes values only by their names, and the arguments are called args."),
        msg("Write {written}."),
        raised={r"\binit\(\) takes 0 positional arguments": _without_keyword},
        fixed_by=(lines.written,),
        examples=(
            example(
                "init_args_without_keyword",
                Replace(NODE, "rclpy.init(args=args)", "rclpy.init(args)"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "init_twice",
        "start",
        msg("rclpy.init() is called twice"),
        msg("rclpy.init() connects the program to ROS; calling it again is an error."),
        msg("Keep only one rclpy.init(args=args), in the first line of {function}."),
        links.RCLPY,
        seen=r"RuntimeError: Context\.init\(\) must only be called once",
        raised={r"Context\.init\(\) must only be called once": _init_twice},
        examples=(
            example(
                "init_twice",
                Replace(
                    NODE,
                    "    rclpy.init(args=args)\n",
                    "    rclpy.init(args=args)\n    rclpy.init(args=args)\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
