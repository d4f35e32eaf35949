"""A loop that calls spin_once in each round, and what else it does."""

from __future__ import annotations

import ast

from grader.package.source.endless import Loop, sleeps_in
from grader.package.source.module import Function
from grader.package.source.names import dotted, last_part
from grader.package.source.node import NodeSource


def loop_around(source: NodeSource, call: ast.Call) -> Loop | None:
    """Return the innermost loop around a call, in the same function."""
    for part in source.module_of(call).around(call):
        if isinstance(part, Function | ast.Lambda):
            return None
        if isinstance(part, Loop):
            return part
    return None


def other_work(source: NodeSource, loop: Loop) -> list[ast.stmt]:
    """Return the statements of a loop that do more than to spin once, to sleep, or nothing."""
    return [part for part in loop.body if not _waits(source, part)]


def _waits(source: NodeSource, part: ast.stmt) -> bool:
    value = part.value if isinstance(part, ast.Expr) else None
    if isinstance(value, ast.Call):
        return last_part(dotted(value.func)) == "spin_once" or value in sleeps_in(source, part)
    return isinstance(value, ast.Constant) or isinstance(part, ast.Pass | ast.Continue)


def only_called(work: list[ast.stmt]) -> ast.Call | None:
    """Return the call, without arguments, of which alone the work of a loop consists."""
    value = work[0].value if len(work) == 1 and isinstance(work[0], ast.Expr) else None
    if not isinstance(value, ast.Call) or value.args or value.keywords:
        return None
    return value if dotted(value.func) and "()" not in dotted(value.func) else None


def until_ros_ends(loop: Loop) -> bool:
    """Return whether only the end of ROS, or an error, ends a loop: while rclpy.ok() without break."""
    if not isinstance(loop, ast.While) or loop.orelse:
        return False
    left = any(isinstance(n, ast.Break | ast.Return | ast.Raise) for n in ast.walk(loop))
    always = isinstance(loop.test, ast.Constant) and bool(loop.test.value)
    asks = isinstance(loop.test, ast.Call) and dotted(loop.test.func) in ("rclpy.ok", "ok")
    return (always or asks) and not left


def condition_of(source: NodeSource, loop: Loop) -> str:
    """Return the condition on which alone a loop goes on; "" if it can end for another reason."""
    leaves = any(isinstance(n, ast.Break | ast.Return | ast.Raise) for n in ast.walk(loop))
    if not isinstance(loop, ast.While) or leaves or isinstance(loop.test, ast.Constant):
        return ""
    code = source.module_of(loop).text.code(loop.test)
    return "" if "\n" in code or dotted(loop.test).endswith("ok()") else code
