"""The number in a node's source that sets the period of its timer, also through a calculation."""

from __future__ import annotations

import ast
import math
import re

from grader.package.source.budget import known
from grader.package.source.counter import targets_of
from grader.package.source.endless import calls_of_methods
from grader.package.source.names import dotted
from grader.package.source.node import NodeSource
from grader.package.source.timer import Timer

ENVIRONMENT = ("os.environ.get", "os.getenv", "environ.get", "getenv")
"""What reads a variable of the environment, with its default behind the name."""
MOST_STEPS = 12
CLOSE = 1e-6  # a share of the period


def timers_of_lines(source: NodeSource) -> list[Timer]:
    """Return the timers whose callback logs, also in a method that it calls; all if none is seen to."""
    return [timer for timer in source.timers if _logs(source, timer.method)] or source.timers


def _logs(source: NodeSource, name: str) -> bool:
    method = source.methods.get(name)
    called = [inner for _, inner in calls_of_methods(source, method)] if method else []
    return any(source.logs(each) for each in (method, *called) if each is not None)


def number_in(value: ast.expr | None) -> float | None:
    """Return the value of a number, or of a product or a fraction of numbers."""
    if isinstance(value, ast.BinOp) and isinstance(value.op, ast.Mult | ast.Div):
        left, right = number_in(value.left), number_in(value.right)
        if not left or not right:
            return None
        return known(left * right if isinstance(value.op, ast.Mult) else left / right)
    if not isinstance(value, ast.Constant) or isinstance(value.value, bool):
        return None
    return float(value.value) if isinstance(value.value, int | float) else None


def is_right(seconds: float | None, wanted: float) -> bool:
    """Whether a period is the wanted one."""
    return seconds is not None and math.isclose(seconds, wanted, rel_tol=CLOSE)


def seconds_of(source: NodeSource, period: ast.expr, steps: int = MOST_STEPS) -> float | None:
    """Return the value of a period, also of a calculation with names; None if it is not known."""
    number = number_in(period)
    if number is not None or steps < 1:
        return number
    if isinstance(period, ast.BinOp) and isinstance(period.op, ast.Mult | ast.Div | ast.FloorDiv):
        left = seconds_of(source, period.left, steps - 1)
        right = seconds_of(source, period.right, steps - 1)
        if left is None or right is None:
            return None
        if isinstance(period.op, ast.Mult):
            return known(left * right)
        if right == 0:
            return None
        return known(left // right if isinstance(period.op, ast.FloorDiv) else left / right)
    if isinstance(period, ast.Call) and dotted(period.func) in ENVIRONMENT and period.args[1:]:
        text = period.args[1]
        found = str(text.value) if isinstance(text, ast.Constant) else ""
        return float(found) if re.fullmatch(r"\d{1,9}(\.\d{0,9})?", found) else None
    if isinstance(period, ast.Call) and dotted(period.func) in ("int", "float"):
        inner = seconds_of(source, period.args[0], steps - 1) if len(period.args) == 1 else None
        return float(int(inner)) if inner is not None and dotted(period.func) == "int" else inner
    name = dotted(period)
    kinds = ast.Assign | ast.AnnAssign
    sets = [s for s in source.own_nodes if isinstance(s, kinds) and name in targets_of(s)]
    value = sets[0].value if name and len(sets) == 1 else None
    return seconds_of(source, value, steps - 1) if value is not None else None
