"""Fixes of a program that waits for the keyboard before the node spins."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from grader.mistakes.fixes import lines
from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.source.counter import logged_counter, targets_of
from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.place import statement_at

LATER = Function | ast.Lambda | ast.If
"""What may run later than the lines around it, or never."""


def input_before_spin(source: NodeSource) -> ast.Call | None:
    """Return the first call of input() at module level, in __init__, or in main before spin."""
    for module in source.modules:
        for call, name in calls_in(module.tree):
            around = list(module.around(call))
            if name == "input" and not any(isinstance(p, LATER) for p in around):
                return call
    for function in (source.methods.get("__init__"), source.main):
        for call, name in _own_calls(function):
            if last_part(name).startswith("spin"):
                break
            if name == "input":
                return call
    return None


def _own_calls(function: Function | None) -> Iterator[tuple[ast.Call, str]]:
    """Yield the calls of a function, without those of functions in it."""
    if function is None:
        return
    inner = [n for n in ast.walk(function) if isinstance(n, Function | ast.Lambda)]
    inside = {call for n in inner if n is not function for call, _ in calls_in(n)}
    for call, name in calls_in(function):
        if call not in inside:
            yield call, name


def counter_of_input(source: NodeSource, call: ast.Call) -> str:
    """Return the counter that a statement sets to what input() returns; "" if it is another."""
    logged = logged_counter(source)
    statement = _statement(source, call)
    targets = list(targets_of(statement)) if isinstance(statement, ast.Assign) else []
    if logged is None or targets != [logged[1]] or not isinstance(statement, ast.Assign):
        return ""
    value = statement.value
    if isinstance(value, ast.Call) and dotted(value.func) in ("int", "float") and value.args:
        value = value.args[0]
    return logged[1] if value is call else ""


def _statement(source: NodeSource, call: ast.Call) -> ast.stmt | None:
    return statement_at(source.module_of(call), call.lineno)


def number(case: Case) -> Files | None:
    """Let the counter begin with the number of the assignment."""
    node = case.node
    call = input_before_spin(node) if node is not None else None
    if node is None or call is None or not counter_of_input(node, call):
        return None
    statement = _statement(node, call)
    if not isinstance(statement, ast.Assign):
        return None
    new = repr(case.assignment.output.start)
    module = node.module_of(call)
    return case.changed(module, module.text.swap(statement.value, new))


def deleted(case: Case) -> Files | None:
    """Delete the line with input() if nothing uses what it returns."""
    node = case.node
    call = input_before_spin(node) if node is not None else None
    statement = _statement(node, call) if node is not None and call is not None else None
    if node is None or call is None or statement is None or call.lineno != case.finding.line:
        return None
    if not isinstance(statement, ast.Expr | ast.Assign) or statement.value is not call:
        return None
    names = set(targets_of(statement))
    used = {dotted(n) for n in node.all_nodes if getattr(n, "ctx", None).__class__ is ast.Load}
    plain = isinstance(statement, ast.Expr) or (len(names) == 1 and not names & used)
    return lines.deleted(case) if plain else None
