"""An attribute that __init__ needs, itself or in a method that it calls, before it sets it."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.package.source.counter import targets_of
from grader.package.source.module import Function, Module
from grader.package.source.names import calls_in, own_name
from grader.package.source.node import NodeSource


@dataclass(frozen=True)
class EarlyUse:
    """The statement of __init__ that needs an attribute, and the later one that sets it."""

    needs: ast.stmt
    sets: ast.Assign | ast.AnnAssign


def early_use(source: NodeSource, module: Module, line: int, name: str) -> EarlyUse | None:
    """Return the early use of `self.name` for which Python stopped at a line of a file.

    None if __init__ does not set the attribute, or if it does so before this line runs.
    """
    own = source.method("__init__")
    for init in dict.fromkeys((own, *_constructors(source))):
        found = _in(source, init, line, name) if init and module.has(init) else None
        if found is not None:
            return found
    return None


def _constructors(source: NodeSource) -> list[Function]:
    """Return the __init__ of the node's class and of its bases in the student's files."""
    methods = [s for c in source.family for s in c.body if isinstance(s, Function)]
    return [method for method in methods if method.name == "__init__"]


def _in(source: NodeSource, init: Function, line: int, name: str) -> EarlyUse | None:
    found = [n for n in ast.walk(init) if f"self.{name}" in targets_of(n)]
    sets = [n for n in found if isinstance(n, ast.Assign | ast.AnnAssign) and n.value]
    first = min(sets, key=lambda n: n.lineno, default=None)
    for statement in init.body:
        if first is None or first.lineno <= statement.lineno:
            return None
        if _has(statement, line) or any(_has(m, line) for m in _reached(source, statement)):
            return EarlyUse(statement, first) if not _has(statement, first.lineno) else None
    return None


def _has(node: ast.stmt, line: int) -> bool:
    return node.lineno <= line <= (node.end_lineno or node.lineno)


def _reached(source: NodeSource, statement: ast.stmt) -> list[Function]:
    """Return the methods that a statement calls, directly or not."""
    reached: list[Function] = []
    waiting: list[ast.AST] = [statement]
    for part in waiting:
        for call, _ in calls_in(part):
            name = own_name(call.func)
            method = source.methods.get(name) or _of_family(source, name)
            if method is not None and method not in reached:
                reached.append(method)
                waiting.append(method)
    return reached


def _of_family(source: NodeSource, name: str) -> Function | None:
    """Return the only method of a name in the node's class and its bases."""
    methods = [s for c in source.family for s in c.body if isinstance(s, Function)]
    found = [method for method in methods if name and method.name == name]
    return found[0] if len(found) == 1 else None
