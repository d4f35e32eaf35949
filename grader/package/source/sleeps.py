"""Sleeps in a node's source."""

from __future__ import annotations

import ast

from grader.package.source.names import calls_in, own_name
from grader.package.source.node import NodeSource

SLEEPS = ("time.sleep", "sleep")


def sleeps_of(source: NodeSource) -> list[ast.Call]:
    """Return the calls with which the callback sleeps in each call, itself or in a method."""
    callback = source.callback
    if callback is None:
        return []
    inner = [source.methods.get(own_name(call.func)) for call, _ in calls_in(callback)]
    calls = [c for part in (callback, *inner) if part is not None for c in calls_in(part)]
    return [call for call, name in calls if name in SLEEPS and not _is_chosen(source, call)]


def _is_chosen(source: NodeSource, call: ast.Call) -> bool:
    """Whether it depends on a condition or on an exception if a call runs."""
    around = source.module_of(call).around(call)
    return any(isinstance(part, ast.If | ast.IfExp | ast.ExceptHandler) for part in around)


def longest_sleep(source: NodeSource) -> tuple[ast.Call, float] | None:
    """Return the callback's longest sleep of those with a literal number of seconds."""
    return max(literal_sleeps(source), key=lambda sleep: sleep[1], default=None)


def literal_sleeps(source: NodeSource) -> list[tuple[ast.Call, float]]:
    """Return the callback's sleeps with a literal number of seconds, and these seconds."""
    return [
        (call, float(call.args[0].value))
        for call in sleeps_of(source)
        if call.args
        and isinstance(call.args[0], ast.Constant)
        and isinstance(call.args[0].value, int | float)
    ]
