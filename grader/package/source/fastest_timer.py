"""The shortest period of a node's timers, as far as its source says it."""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable, Mapping, Sequence

from grader.package.intake.model import SourceFile
from grader.package.source.counter import targets_of
from grader.package.source.names import called_name, dotted, last_part
from grader.package.source.node_modules import node_modules
from grader.package.source.timer import timer_of

MOST_STEPS = 12  # names and operators inside each other
TIMERS = ("create_timer", "create_rate")
OPERATORS: Mapping[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
}


def fastest_timer(files: Sequence[SourceFile]) -> float | None:
    """Return the shortest period (s, above 0) of a timer; None if no period is known.

    A name stands for its value if the package sets it once. Files that cannot be read count as none.
    """
    modules = list(node_modules(files))
    values: dict[str, list[ast.expr]] = {}
    for module in modules:
        for node in module.nodes:
            if isinstance(node, ast.Assign | ast.AnnAssign) and node.value is not None:
                for name in targets_of(node):
                    values.setdefault(last_part(name), []).append(node.value)
    calls = [n for m in modules for n in m.nodes if isinstance(n, ast.Call)]
    periods = [timer_of(c, None).period for c in calls if called_name(c) in TIMERS]
    known = [_number(period, values, MOST_STEPS) for period in periods if period is not None]
    return min((seconds for seconds in known if seconds is not None and seconds > 0), default=None)


def _number(value: ast.expr, values: Mapping[str, list[ast.expr]], steps: int) -> float | None:
    """Return the value of a number, a name or a calculation; None if it is not known."""
    if steps < 1:
        return None
    if isinstance(value, ast.Constant):
        number = value.value
        return float(number) if isinstance(number, int | float) else None
    if isinstance(value, ast.BinOp) and type(value.op) in OPERATORS:
        left, right = (_number(side, values, steps - 1) for side in (value.left, value.right))
        if left is None or right is None:
            return None
        try:
            return OPERATORS[type(value.op)](left, right)
        except (ZeroDivisionError, OverflowError):
            return None
    found = values.get(last_part(dotted(value)), [])
    return _number(found[0], values, steps - 1) if len(found) == 1 else None
