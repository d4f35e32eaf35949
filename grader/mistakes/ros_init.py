"""Mistakes with which a node does not start: rclpy.init(), and an own folder that is called rclpy."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines, node_life
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, on_line
from grader.package.edit.tree import Replace, Write
from grader.package.source.names import dotted, last_part

NOT_INITIALIZED = (
    r"NotInitializedException|Context must be initialized"
    r"|'NoneType' object does not support the context manager protocol|AttributeError: __enter__"
)
"""What rclpy raises before rclpy.init(), also for an executor."""
NO_CONTEXT = r"'(?P<first>\w{1,60})' object does not support the context manager protocol"


def _missing(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """No rclpy.init() is called, or not before the line that raised the error."""
    if "Context" not in match[0] and "Not" not in match[0] and raised.inside != "rclpy":
        return None
    source = raised.source
    written = node_life.init_call(source)
    for node in source.all_nodes:
        if isinstance(node, ast.Expr) and dotted(node.value) == "rclpy.init":
            found = raised.finding("init_missing", at=node, written=written)
            return replace(found, variant="not_called")
    calls = [call for call, name in source.calls if last_part(name) == "init"]
    if not calls:
        return raised.finding("init_missing", written=written)
    is_late = len(calls) == 1 and raised.line is not None and raised.line < calls[0].lineno
    if not is_late:
        return None
    found = raised.finding("init_missing", at=calls[0], written=written)
    return replace(found, variant="late")


def _twice(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    del match
    inits = [call for call, name in raised.source.calls if name == "rclpy.init"]
    found = raised.finding("init_twice", at=inits[-1] if inits else None)
    return found if len(inits) > 1 else replace(raised.finding("init_twice"), variant="imported")


def _not_for_with(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    found = raised.finding("not_for_with", params=match.groupdict(""))
    is_init = "rclpy.init(" in raised.module.line(raised.line)
    return replace(found, variant="init") if is_init else found


_node = Family("node", links.RCLPY)
KINDS = (
    _node(
        "init_missing",
        "start",
        msg("rclpy.init() is not called before the node is created"),
        msg("rclpy.init() connects the program to ROS; no node can be created before it."),
        msg("Write {written} as the first line of {function}."),
        fixes={
            "not_called": msg("Write () after rclpy.init: without them it is not called."),
            "late": msg(
                "Move this call of rclpy.init to the first line of {function}, and create the node in "
                "{function}, below it."
            ),
        },
        seen=r"NotInitializedException",
        raised={NOT_INITIALIZED: _missing},
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
        "init_twice",
        "start",
        msg("rclpy.init() is called twice"),
        msg("rclpy.init() connects the program to ROS; calling it again is an error."),
        msg("Keep only one rclpy.init(args=args), in the first line of {function}."),
        seen=r"RuntimeError: Context\.init\(\) must only be called once",
        fixes={
            "imported": msg(
                "This file has one such call. Either this line runs twice: in a loop, or because {function} "
                "is called twice, also by a line outside of functions. Or another file calls rclpy.init() "
                "when it is imported: look in {package}/__init__.py, which should be empty. Let only one "
                "call run."
            ),
        },
        raised={r"Context\.init\(\) must only be called once": _twice},
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
    _node(
        "not_for_with",
        "spin",
        msg("with gets an object that cannot be used with it"),
        msg(
            "with needs an object that has the methods __enter__ and __exit__. The type {first} does not have them."
        ),
        msg(
            "Assign the object to a name in a line of its own, without with. Then indent the lines of "
            "the block as far as that line."
        ),
        whys={
            "init": msg(
                "From ROS 2 kilted on, rclpy.init() returns an object that works behind with. Here it returns "
                "None, which does not."
            )
        },
        fixes={
            "init": msg(
                "Write the call of rclpy.init() in a line of its own, without with. Then indent the lines of "
                "the block as far as that line."
            )
        },
        fixed_by=(lines.unwrapped,),
        seen=NO_CONTEXT,
        raised={NO_CONTEXT: on_line(_not_for_with)},
        examples=(
            example(
                "node_in_with",
                Replace(
                    NODE,
                    "    node = MyFirstNode()\n    try:\n        rclpy.spin(node)",
                    "    try:\n        with MyFirstNode() as node:\n            rclpy.spin(node)",
                ),
                fails="run.starts",
                right_from="kilted",
                note="a Node can be used with `with` from kilted on",
            ),
        ),
    ),
    _node(
        "ros_hidden",
        "file",
        msg("A folder of your package has the name of a library of ROS"),
        msg(
            "The build installs {name} with your package, and Python finds it before the library of "
            "ROS with the same name. An editor that underlines an import does not know where ROS is; "
            "the import is right all the same."
        ),
        msg(
            "Delete {name}, and the workspace's folders build and install, then build again. In the "
            "package's folder, run: rm -r {name}"
        ),
        links.PACKAGE,
        examples=(
            example(
                "own_folder_rclpy",
                Write("rclpy/__init__.py", ""),
                fails="run.starts",
                note="so that the editor finds the import",
            ),
        ),
    ),
)
