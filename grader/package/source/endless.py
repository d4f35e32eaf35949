"""Loops that keep a function from returning: without an end, or with a sleep in each round."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from grader.package.source.imported import full_name
from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted, last_part, own_name
from grader.package.source.node import NodeSource
from grader.package.source.sleeps import SLEEPS

Loop = ast.While | ast.For
OF_CLOCK = ("sleep_for", "sleep_until")


def goes_on(loop: ast.While) -> bool:
    """Whether a loop has no end before Ctrl+C.

    Its condition is true, or rclpy.ok(), or an attribute that it does not set.
    """
    left = any(isinstance(node, ast.Break | ast.Return) for node in ast.walk(loop))
    tested = dotted(loop.test)
    parts = list(ast.walk(loop))
    sets = any(isinstance(n, ast.Assign) and dotted(n.targets[0]) == tested for n in parts)
    constant = isinstance(loop.test, ast.Constant) and bool(loop.test.value)
    attribute = tested.startswith("self.") and not sets
    return (constant or attribute or tested == "rclpy.ok()") and not left


def sleeps_in(source: NodeSource, part: ast.AST) -> list[ast.Call]:
    """Return the calls in a part of the source that wait: time.sleep under any name."""
    return [
        call
        for call, name in calls_in(part)
        if name in SLEEPS
        or last_part(name) in OF_CLOCK
        or full_name(source.module_of(call), call.func) == "time.sleep"
    ]


def endless_loop(source: NodeSource, function: Function) -> Loop | None:
    """Return the first loop of a function that does not end, or that sleeps in each round."""
    for node in ast.walk(function):
        if isinstance(node, ast.While) and goes_on(node):
            return node
        if isinstance(node, Loop) and sleeps_in(source, node) and not _has_end(node):
            return node
    return None


def _has_end(loop: Loop) -> bool:
    return any(isinstance(node, ast.Break | ast.Return) for node in ast.walk(loop))


def calls_of_methods(source: NodeSource, function: ast.AST) -> Iterator[tuple[ast.Call, Function]]:
    """Yield the calls in a part of the source of the node's own methods, with the method."""
    for call, _ in calls_in(function):
        method = source.methods.get(own_name(call.func))
        if method is not None:
            yield call, method


def methods_run_by(source: NodeSource, part: ast.AST) -> Iterator[Function]:
    """Yield the node's methods that a part of the source calls, also through other methods."""
    seen: list[Function] = []
    waiting: list[ast.AST] = [part]
    while waiting:
        for _, method in calls_of_methods(source, waiting.pop()):
            if method not in seen:
                seen.append(method)
                waiting.append(method)
                yield method
