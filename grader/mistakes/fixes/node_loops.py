"""Fixes of loops that do what a timer does."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.mistakes.fixes import lines
from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.source.endless import Loop, sleeps_in
from grader.package.source.module import Function, Module
from grader.package.source.names import dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of, function_at


def without_loop(case: Case) -> Files | None:
    """Remove the loop of the finding and the sleep in it, and keep its other lines."""
    found = _loop(case)
    if found is None or case.node is None or _counts_itself(found[1], found[2]):
        return None
    unwrapped = lines.unwrapped(case)
    module, _, function = found
    after = replace(case, files=unwrapped) if unwrapped is not None else case
    files = _without_sleep(after, module.path, function.name) if unwrapped is not None else None
    return lines.without_import(replace(case, files=files), "time") if files is not None else None


def _loop(case: Case) -> tuple[Module, Loop, Function] | None:
    """Return the loop of the finding, its file, and the function around it."""
    module, line = case.module, case.finding.line
    found = [
        n for n in (module.nodes if module else ()) if isinstance(n, Loop) and n.lineno == line
    ]
    function = function_at(module, line) if module is not None else None
    if module is None or len(found) != 1 or function is None:
        return None
    return module, found[0], function


def _counts_itself(loop: Loop, function: Function) -> bool:
    """Whether the loop changes a variable of the function, which the next call does not know."""
    inside = {n.id for n in ast.walk(loop) if isinstance(n, ast.Name) and _is_set(n)}
    before = [n for s in function.body if s.lineno < loop.lineno for n in ast.walk(s)]
    return any(isinstance(n, ast.Name) and n.id in inside and _is_set(n) for n in before)


def _is_set(name: ast.Name) -> bool:
    return isinstance(name.ctx, ast.Store)


def _without_sleep(case: Case, path: str, name: str) -> Files | None:
    """Delete the sleeps of a method, each a statement on its own line."""
    node: NodeSource | None = case.node
    method = node.method(name) if node is not None else None
    if node is None or method is None:
        return None
    module, splices = node.module_at(path), []
    calls = [n for n in ast.walk(method) if isinstance(n, ast.Call)]
    of_rates = [c for c in calls if last_part(dotted(c.func)) == "sleep"]
    for call in {*sleeps_in(node, method), *of_rates}:
        statement = module.parents.get(call)
        if not isinstance(statement, ast.Expr) or len(block_of(module, statement)) == 1:
            return None
        if module.text.line(statement.lineno).strip() != module.text.code(statement):
            return None
        splices.append(module.text.without(statement.lineno))
    return case.changed(module, *splices) if splices else case.files
