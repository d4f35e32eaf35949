"""Threads that a node starts with threading.Thread."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.package.source.counter import targets_of
from grader.package.source.endless import Loop, calls_of_methods, endless_loop
from grader.package.source.module import Function
from grader.package.source.names import dotted, own_name
from grader.package.source.node import NodeSource


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
        given = {keyword.arg: keyword.value for keyword in call.keywords}
        named = given.get("target")
        method = source.methods.get(own_name(named))
        function = source.module_of(call).functions.get(dotted(named) if named else "")
        target = method or function
        loop = endless_loop(source, target) if target is not None else None
        if target is not None and loop is not None:
            daemon = _is_true(given.get("daemon")) or _set_to_daemon(source, call)
            found.append(OwnThread(call, target, loop, daemon))
    return found


def variables_of(source: NodeSource, call: ast.Call) -> set[str]:
    """Return the variables that get a thread."""
    made = source.module_of(call).parents.get(call)
    return set(targets_of(made)) if made is not None else set()


def _set_to_daemon(source: NodeSource, call: ast.Call) -> bool:
    names = variables_of(source, call)
    return any(
        isinstance(node, ast.Assign)
        and _is_true(node.value)
        and any(dotted(target) in {f"{name}.daemon" for name in names} for target in node.targets)
        for node in source.all_nodes
    )


def _is_true(value: ast.expr | None) -> bool:
    return isinstance(value, ast.Constant) and value.value is True
