"""Mistakes in which a call is written as an assignment: a = or a colon before the brackets."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, SILENT, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.module import Module
from grader.package.source.names import dotted
from grader.package.source.place import statement_at

CALLED = (
    *("create_timer", "create_publisher", "create_subscription", "create_service"),
    *("create_client", "declare_parameter"),
)
"""Methods of Node that a class calls on itself, and never sets."""
SPINS = ("rclpy.spin", "rclpy.spin_once")
READ_ONLY = r"AttributeError: 'super' object (?:attribute '__init__' is read-only|has no attribute)"


def _assignments(module: Module) -> Iterator[tuple[ast.Assign | ast.AnnAssign, str, ast.expr]]:
    """Yield the statements `x = y` and `x: y`, with the name x and what stands for y."""
    for node in module.nodes:
        if isinstance(node, ast.Assign) and len(node.targets) == 1:
            yield node, dotted(node.targets[0]), node.value
        elif isinstance(node, ast.AnnAssign) and node.value is None:
            yield node, dotted(node.target), node.annotation


def _given(module: Module, value: ast.expr) -> str:
    """Return the arguments in brackets, as they are written."""
    code = module.text.code(value)
    inside = isinstance(value, ast.Tuple) and code.startswith("(")
    return code if inside else f"({code})"


def _timer(suspect: Suspect) -> RecognisedMistake | None:
    """create_timer gets a value, or the arguments are assigned without it."""
    source = suspect.source
    for module in source.modules:
        for statement, name, value in _assignments(module):
            if statement not in source.own_nodes or "\n" in module.text.code(statement):
                continue
            own, _, method = name.partition(".")
            if own == "self" and method in CALLED and isinstance(value, ast.Tuple):
                return _told(suspect, module, statement, f"{name}{_given(module, value)}")
            if _is_timer(suspect, value) and isinstance(statement, ast.Assign):
                new = f"{name} = self.create_timer{_given(module, value)}"
                found = _told(suspect, module, statement, new)
                return replace(
                    found, variant="call", words={**found.words, "method": "create_timer"}
                )
    return None


def _is_timer(suspect: Suspect, value: ast.expr) -> bool:
    """Whether a tuple is a period and a method of the class, in a node without a timer."""
    if suspect.source.timers or not isinstance(value, ast.Tuple) or len(value.elts) != 2:
        return False
    period, callback = value.elts
    number = isinstance(period, ast.Constant) and type(period.value) in (int, float)
    own, _, method = dotted(callback).partition(".")
    return number and own == "self" and method in suspect.source.methods


def _spin(suspect: Suspect) -> RecognisedMistake | None:
    """rclpy.spin gets a value."""
    for module in suspect.source.modules:
        for statement, name, value in _assignments(module):
            if name in SPINS and _is_node(suspect, value):
                return _told(suspect, module, statement, f"{name}{_given(module, value)}")
    return None


def _is_node(suspect: Suspect, value: ast.expr) -> bool:
    made = isinstance(value, ast.Call) and suspect.source.is_node_class(value.func)
    return made or dotted(value) in suspect.source.node_variables


def _told(
    suspect: Suspect, module: Module, statement: ast.Assign | ast.AnnAssign, written: str
) -> RecognisedMistake:
    name = module.text.code(statement)
    found = suspect.finding("call_assigned", statement, name=name, written=written)
    words = {**found.words, "method": written.partition("(")[0]}
    variant = "colon" if isinstance(statement, ast.AnnAssign) else ""
    return replace(found, variant=variant, words=words)


def _super(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """super().__init__ gets a value."""
    del match
    statement = statement_at(raised.module, raised.line)
    target = statement.targets[0] if isinstance(statement, ast.Assign) else None
    if target is None or not isinstance(statement, ast.Assign):
        return None
    name = dotted(target)
    if not name.startswith("super().") or "\n" in raised.module.text.code(statement):
        return None
    suspect = Suspect(raised.source, raised.assignment)
    written = f"{name}{_given(raised.module, statement.value)}"
    return _told(suspect, raised.module, statement, written)


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "call_assigned",
        "timer",
        msg("A call is written as an assignment"),
        msg(
            "With =, this line does not call {method}, but tries to replace it with a value. A function is called by its name and, directly behind it, the "
            "brackets."
        ),
        msg("Remove the = sign. Write {written} instead of {name}"),
        whys={
            "colon": msg(
                "With a colon, this line calls nothing: a colon after a name only states a type. A "
                "function is called by its name and, directly behind it, the brackets."
            ),
            "call": msg(
                "This line calls nothing: it only gives the values in the brackets to a name. The "
                "function {method} makes the timer."
            ),
        },
        fixes={
            "colon": msg("Remove the colon. Write {written} instead of {name}"),
            "call": msg("Write {written} instead of {name}"),
        },
        raised={READ_ONLY: _super},
        behind={
            "run.no_lines": _timer,
            "run.never_spins": _spin,
            "run.exits_at_once": _spin,
            "run.no_node": _spin,
        },
        fixed_by=(lines.written,),
        examples=(
            example(
                "create_timer_assigned",
                Replace(NODE, "self.create_timer(1.0", "self.create_timer = (1.0"),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "create_timer_with_colon",
                Replace(NODE, "self.create_timer(1.0", "self.create_timer: (1.0"),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "timer_without_create_timer",
                Replace(NODE, "self.create_timer(1.0", "self.timer_ = (1.0"),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "spin_assigned",
                Replace(NODE, "rclpy.spin(node)", "rclpy.spin = node"),
                fails="run.starts",
            ),
            example(
                "super_init_assigned",
                Replace(NODE, "__init__('my_first_node')", "__init__ = 'my_first_node'"),
                fails="run.starts",
            ),
        ),
    ),
)
