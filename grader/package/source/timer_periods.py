"""The periods of a node's timers, as far as its source says them."""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from grader.package.intake.model import SourceFile
from grader.package.source.budget import known
from grader.package.source.counter import targets_of
from grader.package.source.names import called_name, dotted, last_part
from grader.package.source.node_modules import node_modules
from grader.package.source.timer import timer_of

MOST_STEPS = 12  # names and operators inside each other
OPERATORS: Mapping[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
}


@dataclass(frozen=True)
class TimerPeriods:
    """The period (s) of each timer; None where the source does not say it."""

    seconds: tuple[float | None, ...] = ()

    @property
    def fastest(self) -> float | None:
        """The shortest period above 0; None if no period is known."""
        above = (seconds for seconds in self.seconds if seconds is not None and seconds > 0)
        return min(above, default=None)

    @property
    def are_known(self) -> bool:
        """Whether there is a timer, and the period of each is known."""
        return bool(self.seconds) and None not in self.seconds


def timer_periods(files: Sequence[SourceFile]) -> TimerPeriods:
    """Return the periods of the timers in the files.

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
    timers = [timer_of(call, None).period for call in calls if called_name(call) == "create_timer"]
    rates = [_frequency_of(call) for call in calls if called_name(call) == "create_rate"]

    def number(value: ast.expr | None) -> float | None:
        return None if value is None else _number(value, values, MOST_STEPS)

    hertz = [number(rate) for rate in rates]
    return TimerPeriods((*map(number, timers), *(1 / rate if rate else None for rate in hertz)))


def _frequency_of(call: ast.Call) -> ast.expr | None:
    """Return the frequency (Hz) that create_rate gets."""
    given = [keyword.value for keyword in call.keywords if keyword.arg == "frequency"]
    return next(iter([*call.args, *given]), None)


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
            return known(OPERATORS[type(value.op)](left, right))
        except (ZeroDivisionError, OverflowError):
            return None
    found = values.get(last_part(dotted(value)), [])
    return _number(found[0], values, steps - 1) if len(found) == 1 else None
