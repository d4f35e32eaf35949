"""The time after which a node's own code may end it, as far as its source says."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from grader.package.intake.model import SourceFile
from grader.package.source.module import Module
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node_modules import node_modules
from grader.package.source.period import number_in
from grader.package.source.real_time import CLOCKS

LIMITED = "spin_until_future_complete"
TIMEOUTS = (3, 1)
"""The position of timeout_sec: rclpy's function has node, future and executor before it, an
executor's method only the future (rclpy, __init__.py and executors.py)."""


def ends_after(files: Sequence[SourceFile]) -> float:
    """Return the longest such time in seconds of wall time, 0 if the source has none.

    It is the timeout of spin_until_future_complete, or a number that is compared with the time that
    a clock of Python says. Times that the source does not have as numbers are left out.
    """
    found = [seconds for module in node_modules(files) for seconds in _times(module)]
    return max(found, default=0.0)


def timeout_of(call: ast.Call) -> ast.expr | None:
    """Return the timeout that a call of spin_until_future_complete gets, None if it gets none."""
    named = [word.value for word in call.keywords if word.arg == "timeout_sec"]
    place = TIMEOUTS[0] if dotted(call.func) in ("rclpy." + LIMITED, LIMITED) else TIMEOUTS[1]
    given = [*named, *call.args[place:]]
    return given[0] if given else None


def constant(module: Module, value: ast.expr | None) -> float | None:
    """Return a number that stands in the source, or that a name stands for which gets one value."""
    if not isinstance(value, ast.Name | ast.Attribute):
        return number_in(value)
    name = last_part(dotted(value))
    given = [
        node.value
        for node in module.nodes
        if isinstance(node, ast.Assign | ast.AnnAssign)
        and name in [last_part(dotted(target)) for target in _targets(node)]
    ]
    return number_in(given[0]) if len(given) == 1 else None


def _targets(node: ast.Assign | ast.AnnAssign) -> list[ast.expr]:
    return node.targets if isinstance(node, ast.Assign) else [node.target]


def _times(module: Module) -> Iterator[float]:
    for call, name in calls_in(module.tree):
        if last_part(name) == LIMITED:
            yield constant(module, timeout_of(call)) or 0.0
    for node in module.nodes:
        if isinstance(node, ast.Compare) and _asks_a_clock(node):
            parts = [part for part in ast.walk(node) if isinstance(part, ast.expr)]
            yield from (constant(module, part) or 0.0 for part in parts)


def _asks_a_clock(node: ast.Compare) -> bool:
    return any(last_part(name) in CLOCKS for _, name in calls_in(node))
