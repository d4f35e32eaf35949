"""Sleeps in a node's source."""

from __future__ import annotations

import ast

from grader.package.source.names import calls_in, own_name
from grader.package.source.node import NodeSource

SLEEPS = ("time.sleep", "sleep")


def longest_sleep(source: NodeSource) -> float:
    """Return the seconds of the longest sleep that the callback makes in each call, itself or in a method.

    Only those whose seconds are in the call count; 0 if there is none.
    """
    callback = source.callback
    inner = calls_in(callback) if callback is not None else ()
    methods = [source.methods.get(own_name(call.func)) for call, _ in inner]
    found = [
        float(call.args[0].value)
        for part in (callback, *methods)
        for call, name in (calls_in(part) if part is not None else ())
        if name in SLEEPS and call.args and isinstance(call.args[0], ast.Constant)
        if isinstance(call.args[0].value, int | float) and not _is_chosen(source, call)
    ]
    return max(found, default=0.0)


def _is_chosen(source: NodeSource, call: ast.Call) -> bool:
    """Whether it depends on a condition or on an exception if a call runs."""
    around = source.module_of(call).around(call)
    return any(isinstance(part, ast.If | ast.IfExp | ast.ExceptHandler) for part in around)
