"""Waiting by the wall clock in the callback that works on an action's goals."""

from __future__ import annotations

import ast

from grader.package.source.endless import OF_CLOCK, sleeps_in
from grader.package.source.names import dotted, last_part, own_name
from grader.package.source.node import NodeSource

EXECUTE = 3  # the place of execute_callback among the arguments of rclpy's ActionServer


def sleep_in_action(source: NodeSource) -> ast.Call | None:
    """Return the first time.sleep() in the callback of an ActionServer, or in a method it calls."""
    for server in source.calls_of("ActionServer"):
        named = [one.value for one in server.keywords if one.arg == "execute_callback"]
        given = next(iter([*server.args[EXECUTE : EXECUTE + 1], *named]), None)
        execute = source.methods.get(own_name(given)) if given is not None else None
        if execute is None:
            continue
        calls = [node for node in ast.walk(execute) if isinstance(node, ast.Call)]
        inner = [source.methods.get(own_name(call.func)) for call in calls]
        for part in (execute, *(one for one in inner if one is not None)):
            for call in sleeps_in(source, part):
                if last_part(dotted(call.func)) not in OF_CLOCK:
                    return call
    return None
