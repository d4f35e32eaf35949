"""Timers that are created in lines below rclpy.spin, which run only after it has returned."""

from __future__ import annotations

import ast

from grader.package.source.names import called_name, calls_in, last_part
from grader.package.source.node import NodeSource


def timer_after_spin(source: NodeSource) -> tuple[ast.Call, ast.Call] | None:
    """Return the call below spin that creates the node's timers, and the call of spin.

    None if a timer may be created in another way, before spin.
    """
    makers = _makers(source)
    for spin in _spinning(source):
        function, below = source.function_around(spin), _below(source, spin)
        late = [call for call in below if called_name(call) in {"create_timer", *makers}]
        named = [n for n in source.all_nodes if isinstance(n, ast.Attribute) and n.attr in makers]
        called = {call.func for call in late}
        made = {timer.call for timer in source.timers if timer.function is function}
        inside = all(
            timer.call in late or (timer.function and timer.function.name in makers)
            for timer in source.timers
        )
        if late and inside and made <= set(late) and all(name in called for name in named):
            return late[0], spin
    return None


def _below(source: NodeSource, spin: ast.Call) -> list[ast.Call]:
    """Return the calls in lines below a call of spin; none if it is in no function."""
    function = source.function_around(spin)
    calls = calls_in(function) if function is not None else ()
    return [call for call, _ in calls if _is_below(source, call, spin)]


def _spinning(source: NodeSource) -> list[ast.Call]:
    """Return the calls of spin, and those of functions that spin."""
    spins = source.calls_of("spin")
    around = [source.function_around(spin) for spin in spins]
    names = {f.name for f in around if f is not None and f is not source.main}
    return [*spins, *(call for call, name in source.calls if last_part(name) in names)]


def _makers(source: NodeSource) -> set[str]:
    """Return the node's methods that create a timer, without __init__."""
    own = {timer.function.name for timer in source.timers if timer.function is not None}
    return (own & set(source.methods)) - {"__init__"}


def _is_below(source: NodeSource, call: ast.Call, spin: ast.Call) -> bool:
    """Whether a call comes after spin in the function, and not in an except or a loop with it."""
    module = source.module_of(spin)
    around = list(module.around(spin))
    if any(isinstance(part, ast.While | ast.For | ast.Lambda) for part in around):
        return False
    handled = any(isinstance(part, ast.ExceptHandler) for part in module.around(call))
    same = source.function_around(call) is source.function_around(spin)
    return same and call.lineno > spin.lineno and not handled
