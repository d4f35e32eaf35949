"""Threads that a node starts with threading.Thread."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.package.source.counter import targets_of
from grader.package.source.endless import Loop, calls_of_methods, endless_loop
from grader.package.source.module import Function
from grader.package.source.names import dotted, own_name
from grader.package.source.node import NodeSource

PLACES = {"target": 1, "args": 3}
"""The places of the arguments of Thread that are given without their names."""


@dataclass(frozen=True)
class OwnThread:
    """A call of Thread with a method or a function of the files, and the loop in that."""

    call: ast.Call
    target: Function
    loop: Loop
    daemon: bool

    def logs(self, source: NodeSource) -> bool:
        """Whether the loop logs, itself or in a method that it calls."""
        called = [method for _, method in calls_of_methods(source, self.loop)]
        return any(source.logs(part) for part in (self.loop, *called))


def own_threads(source: NodeSource) -> list[OwnThread]:
    """Return the threads of a node that run a loop without an end."""
    found = []
    for call in source.calls_of("Thread"):
        named = argument(call, "target")
        method = source.methods.get(own_name(named))
        function = source.module_of(call).functions.get(dotted(named) if named else "")
        target = method or function
        loop = endless_loop(source, target) if target is not None else None
        if target is not None and loop is not None:
            found.append(OwnThread(call, target, loop, is_daemon(source, call)))
    return found


def variables_of(source: NodeSource, call: ast.Call) -> set[str]:
    """Return the variables that get a thread."""
    made = source.module_of(call).parents.get(call)
    return set(targets_of(made)) if made is not None else set()


def argument(call: ast.Call, name: str) -> ast.expr | None:
    """Return an argument of Thread, given by its name or by its place."""
    for word in call.keywords:
        if word.arg == name:
            return word.value
    place = PLACES[name]
    starred = any(isinstance(given, ast.Starred) for given in call.args)
    return call.args[place] if len(call.args) > place and not starred else None


def is_daemon(source: NodeSource, call: ast.Call) -> bool:
    """Whether a thread is a daemon: made as one, or set to be one later."""
    if any(word.arg == "daemon" and _is_true(word.value) for word in call.keywords):
        return True
    names = variables_of(source, call)
    set_true = {
        dotted(target)
        for node in source.all_nodes
        if isinstance(node, ast.Assign) and _is_true(node.value)
        for target in node.targets
    }
    called = {name for made, name in source.calls if made.args and _is_true(made.args[0])}
    return any(f"{name}.daemon" in set_true or f"{name}.setDaemon" in called for name in names)


def _is_true(value: ast.expr) -> bool:
    return isinstance(value, ast.Constant) and value.value is True
