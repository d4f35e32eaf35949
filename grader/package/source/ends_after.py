"""The time after which a node's own code may end it, as far as its source says."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from grader.package.intake.model import SourceFile
from grader.package.source.module import Function, Module
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node_modules import node_modules
from grader.package.source.period import number_in
from grader.package.source.real_time import CLOCKS

WRAPS = ast.Mod | ast.BitAnd  # after which a count begins anew
MOST_COUNT = 60
"""Larger numbers that a count is compared with are not waited for."""
WAITS = ("Timer", "alarm", "setitimer", "sleep")
"""Functions of Python whose first or second value is a time in seconds of wall time."""
DEEPEST = 1000
"""How often a function may call itself (sys.getrecursionlimit)."""
LIMITED = "spin_until_future_complete"
TIMEOUTS = (3, 1)
"""The position of timeout_sec: rclpy's function has node, future and executor before it, an
executor's method only the future (rclpy, __init__.py and executors.py)."""


def ends_after(files: Sequence[SourceFile]) -> float:
    """Return the longest such time in seconds of wall time, 0 if the source has none.

    It is the timeout of spin_until_future_complete, what a function waits for, such as a timer of a
    thread, or a number that is compared with the time that a clock of Python says. Times that the source does not have as numbers are left out.
    """
    found = [seconds for module in node_modules(files) for seconds in _times(module)]
    return max(found, default=0.0)


def counts_to(files: Sequence[SourceFile]) -> int:
    """Return the largest number up to MOST_COUNT with which a count is compared or divided.

    0 if the source has none. At this number a node may end, or begin anew.
    """
    found = [number for module in node_modules(files) for number in _limits(module)]
    return max((int(number) for number in found if 0 < number <= MOST_COUNT), default=0)


def _limits(module: Module) -> Iterator[float]:
    counted = {dotted(n.target) for n in module.nodes if isinstance(n, ast.AugAssign)}
    for node in module.nodes:
        if isinstance(node, ast.Assign):
            inside = {dotted(part) for part in ast.walk(node.value)}
            counted |= {name for target in node.targets if (name := dotted(target)) in inside}
    counted = {last_part(name) for name in counted} - {""}
    for node in module.nodes:
        divides = isinstance(node, ast.BinOp | ast.AugAssign) and isinstance(node.op, WRAPS)
        if divides or isinstance(node, ast.Compare):
            parts = [part for part in ast.walk(node) if isinstance(part, ast.expr)]
            if counted & {last_part(dotted(part)) for part in parts}:
                yield from (constant(module, part) or 0.0 for part in parts)


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
    given = _given(module, value)
    return number_in(given[0]) if len(given) == 1 else None


def _given(module: Module, name: ast.expr) -> list[ast.expr]:
    """Return the values that a name gets."""
    last = last_part(dotted(name))
    return [
        node.value
        for node in module.nodes
        if isinstance(node, ast.Assign | ast.AnnAssign)
        and node.value is not None
        and last in [last_part(dotted(target)) for target in _targets(node)]
    ]


def _targets(node: ast.Assign | ast.AnnAssign) -> list[ast.expr]:
    return node.targets if isinstance(node, ast.Assign) else [node.target]


def _times(module: Module) -> Iterator[float]:
    for call, name in calls_in(module.tree):
        if last_part(name) == LIMITED:
            yield constant(module, timeout_of(call)) or 0.0
        if last_part(name) in WAITS:
            yield from (constant(module, given) or 0.0 for given in call.args[:2])
    for node in module.nodes:
        if isinstance(node, ast.Compare):
            yield from _compared(module, node)
        if isinstance(node, Function):
            yield from _recurses(module, node)


def _recurses(module: Module, function: Function) -> Iterator[float]:
    """Yield after how many seconds a function that spins once and calls itself has done it too often."""
    calls = list(calls_in(function))
    if any(last_part(name) == function.name for _, name in calls):
        for call, name in calls:
            if last_part(name) == "spin_once":
                named = [word.value for word in call.keywords if word.arg == "timeout_sec"]
                given = [*named, *call.args[1:]]
                yield DEEPEST * (constant(module, given[0]) or 0.0) if given else 0.0


def _compared(module: Module, node: ast.Compare) -> Iterator[float]:
    """Yield the numbers of a comparison with the time, and of a time to which its names are set."""
    parts = [part for part in ast.walk(node) if isinstance(part, ast.expr)]
    names = [part for part in parts if isinstance(part, ast.Name | ast.Attribute)]
    times = [value for name in names for value in _given(module, name) if _asks_a_clock(value)]
    if times or _asks_a_clock(node):
        yield from (constant(module, part) or 0.0 for part in parts)
    for value in times:
        inside = [part for part in ast.walk(value) if isinstance(part, ast.expr)]
        yield from (constant(module, part) or 0.0 for part in inside)


def _asks_a_clock(node: ast.AST) -> bool:
    return any(last_part(name) in (*CLOCKS, "now") for _, name in calls_in(node))
