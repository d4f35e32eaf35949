"""The mistake of a node that spins below the `with` block at whose end ROS is shut down."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import BODY_OF_MAIN, NODE, example
from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.node_order import SPINS
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.edit.tree import Replace
from grader.package.source.module import Function, Module
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.place import block_of, statement_at

NO_ROS = (
    r"'NoneType' object does not support the context manager protocol|AttributeError: __enter__"
    r"|NotInitializedException|context is (?:not valid|invalid)|InvalidHandle"
)
NO_CONTEXT = (
    r"'NoneType' object does not support the context manager protocol|AttributeError: __enter__"
)
SHUTS = ("shutdown", "try_shutdown")
OWN_CONTEXT = """\
class Ros:

    def __enter__(self):
        rclpy.init()

    def __exit__(self, *error):
        rclpy.try_shutdown()


"""


def _below(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line is below a `with` of the student's own that shuts ROS down at its end."""
    del match
    module = raised.module
    for block, first in _ended(raised, module):
        statements = block_of(module, block)
        after = statements[statements.index(block) + 1 :]
        last = next(s for s in after if _has(s, raised.line))
        end = last.end_lineno or last.lineno
        params = {"line": str(block.lineno), "first": str(after[0].lineno), "last": str(end)}
        found = raised.finding("below_with", params=params)
        words = {**found.words, "indented": str(first)}
        return replace(found, words=words, variant="one" if after[0].lineno == end else "")
    return None


def _ended(raised: Raised, module: Module) -> Iterator[tuple[ast.With, int]]:
    """Yield the `with` above the line that shuts ROS down, and the first line of its block."""
    for node in module.nodes:
        if not isinstance(node, ast.With) or _has(node, raised.line):
            continue
        statements = block_of(module, node)
        after = statements[statements.index(node) + 1 :] if node in statements else []
        if any(_has(s, raised.line) for s in after) and any(
            _shuts(raised, item.context_expr) for item in node.items
        ):
            yield node, node.body[0].lineno


def _has(statement: ast.stmt, line: int | None) -> bool:
    return statement.lineno <= (line or 0) <= (statement.end_lineno or statement.lineno)


def _shuts(raised: Raised, given: ast.expr) -> bool:
    """Whether a `with` calls an own function, or an own class, that shuts ROS down at its end."""
    name = last_part(dotted(given.func)) if isinstance(given, ast.Call) else ""
    for module in raised.source.modules if name else ():
        made = module.functions.get(name)
        decorators = [last_part(dotted(d)) for d in made.decorator_list] if made else []
        if made is not None and decorators == ["contextmanager"]:
            return _always_shuts(made)
        for found in module.classes:
            exits = [s for s in found.body if isinstance(s, Function) and s.name == "__exit__"]
            if found.name == name and exits:
                return _always_shuts(exits[-1])
    return False


def _always_shuts(function: Function) -> bool:
    """Whether a function shuts ROS down, and no condition decides over it."""
    conditions = (ast.If, ast.While, ast.For, ast.Match, ast.ExceptHandler)
    unsure = {n for c in ast.walk(function) if isinstance(c, conditions) for n in ast.walk(c)}
    return any(last_part(name) in SHUTS and call not in unsure for call, name in calls_in(function))


def _not_running(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Rclpy finds no running ROS when a line spins."""
    del match
    statement = statement_at(raised.module, raised.line)
    calls = [last_part(name) for _, name in calls_in(statement)] if statement is not None else []
    spins = any(name in SPINS or name.endswith("Executor") for name in calls)
    return raised.finding("ros_not_running") if raised.inside == "rclpy" and spins else None


def _indented(case: Case) -> Files | None:
    """Indent the lines below the `with` as far as its block."""
    module, params = case.module, case.finding.params
    found = [
        n
        for n in (module.nodes if module is not None else [])
        if isinstance(n, ast.With) and str(n.lineno) == str(params.get("line"))
    ]
    if module is None or len(found) != 1 or found[0].body[0].lineno == found[0].lineno:
        return None
    text, block = module.text, found[0]
    inner, outer = (indent_of(text.line(n)) for n in (block.body[0].lineno, block.lineno))
    rows = range(int(params.get("first", 0)), int(params.get("last", 0)) + 1)
    starts = [text.start_of(row) for row in rows if text.line(row).strip()]
    return case.changed(module, *(Splice(at, at, inner.removeprefix(outer)) for at in starts))


_node = Family("node", links.RCLPY)
KINDS = (
    _node(
        "below_with",
        "shutdown",
        msg("The node is used below the with block that shuts ROS down"),
        msg(
            "At the end of its block, the with in line {line} shuts ROS down. The lines below the block "
            "run after that, and without ROS no node can be created or spin."
        ),
        msg(
            "Move lines {first} to {last} into the block of the with: indent them further, so that line "
            "{first} begins below the beginning of line {indented}."
        ),
        fixes={
            "one": msg(
                "Move line {first} into the block of the with: indent it as far as line {indented}."
            )
        },
        raised={NO_ROS: _below},
        fixed_by=(_indented,),
        examples=(
            example(
                "spin_below_a_with_of_ros",
                Replace(NODE, "class MyFirstNode(", f"{OWN_CONTEXT}class MyFirstNode("),
                Replace(
                    NODE,
                    BODY_OF_MAIN,
                    "    with Ros():\n        node = MyFirstNode()\n    rclpy.spin(node)\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "ros_not_running",
        "shutdown",
        msg("ROS is not running at this line"),
        msg(
            "rclpy works only between rclpy.init() and the shutdown. On this line there is no running ROS: "
            "it has been shut down before, or rclpy.init() has not run."
        ),
        msg(
            "Follow {function} from its first line to this line, with all that it calls, and find what "
            "shuts ROS down: rclpy.shutdown(), rclpy.try_shutdown(), or the end of a with block. That must "
            "come after this line."
        ),
        raised={NO_CONTEXT: _not_running},
    ),
)
