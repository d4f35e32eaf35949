"""Mistakes in what a variable holds that is used as a node or an executor: a tuple, a list, a class."""

from __future__ import annotations

import ast
import re

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.names import dotted, last_part
from grader.package.source.place import statement_at

EXECUTORS = ("SingleThreadedExecutor", "MultiThreadedExecutor", "EventsExecutor")
OF_CLASS = (
    r"TypeError: .{1,200} missing \d{1,3} required positional argument"
    r"|AttributeError: (?:type object '|'property' object)|'property' object is not iterable"
)


def _is_class(raised: Raised, value: ast.expr) -> bool:
    name = last_part(dotted(value)) if isinstance(value, ast.Name | ast.Attribute) else ""
    own = name in raised.source.known_classes and raised.source.is_node_class(value)
    return own or (name in EXECUTORS and name in raised.module.imports | {name})


def _class(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A variable holds the class, which the line that sets it does not call."""
    del match
    statement = statement_at(raised.module, raised.line)
    used = {dotted(n) for n in ast.walk(statement or raised.module.tree)} - {""}
    sets = [
        n
        for n in raised.source.all_nodes
        if isinstance(n, ast.Assign) and len(n.targets) == 1 and used & set(targets_of(n))
    ]
    sets = [n for n in sets if _is_class(raised, n.value)]
    if len(sets) != 1:
        return None
    text = raised.source.module_of(sets[0]).text
    name = text.code(sets[0])
    if "\n" in name:
        return None
    params = {"name": name, "variable": dotted(sets[0].targets[0])}
    params |= {"type": text.code(sets[0].value), "written": f"{name}()"}
    return raised.finding("class_not_called", at=sets[0], params=params)


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "class_not_called",
        "start",
        msg("The () after the class is missing"),
        msg("The name of a class creates no object; only calling it does."),
        msg("Write {written} on this line."),
        raised={OF_CLASS: _class},
        fixed_by=(lines.written,),
        examples=(
            example(
                "node_not_made",
                Replace(NODE, "node = MyFirstNode()", "node = MyFirstNode"),
                fails="run.starts",
            ),
            example(
                "executor_class_not_called",
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    "        executor = SingleThreadedExecutor\n"
                    "        executor.add_node(node)\n"
                    "        executor.spin()\n",
                ),
                Replace(
                    NODE,
                    "from rclpy.node",
                    "from rclpy.executors import SingleThreadedExecutor\nfrom rclpy.node",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
