"""Sleeps in a node's source."""

from __future__ import annotations

import ast

from grader.package.source.names import calls_in
from grader.package.source.node import NodeSource

SLEEPS = ("time.sleep", "sleep")


def sleeps_of(source: NodeSource) -> list[ast.Call]:
    """Return the calls with which the callback sleeps."""
    calls = calls_in(source.callback) if source.callback is not None else ()
    return [call for call, name in calls if name in SLEEPS]


def longest_sleep(source: NodeSource) -> tuple[ast.Call, float] | None:
    """Return the callback's longest sleep of those with a literal number of seconds."""
    found = [
        (call, float(call.args[0].value))
        for call in sleeps_of(source)
        if call.args
        and isinstance(call.args[0], ast.Constant)
        and isinstance(call.args[0].value, int | float)
    ]
    return max(found, key=lambda sleep: sleep[1], default=None)
