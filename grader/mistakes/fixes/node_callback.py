"""Fixes of what runs in a callback, of the order in it, and of what calls it."""

from __future__ import annotations

import ast

from grader.mistakes.fixes import lines
from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.source.counter import targets_of
from grader.package.source.module import Module
from grader.package.source.names import dotted
from grader.package.source.place import block_of, statement_at
from grader.package.source.sleeps import sleeps_of


def _statement(case: Case) -> tuple[Module, ast.stmt, range] | None:
    """Return the file and the statement of the finding, and its lines if no other code is on them."""
    module = case.module
    statement = statement_at(module, case.finding.line) if module is not None else None
    rows = lines.own_lines(module, statement) if module is not None and statement else None
    if module is None or statement is None or rows is None:
        return None
    return module, statement, rows


def without_sleeps(case: Case) -> Files | None:
    """Delete the sleeps of the callback that it makes in each call."""
    node = case.node
    if node is None:
        return None
    splices: list[Splice] = []
    modules: set[Module] = set()
    for call in sleeps_of(node):
        module = node.module_of(call)
        statement = module.parents.get(call)
        rows = lines.own_lines(module, statement) if isinstance(statement, ast.Expr) else None
        if rows is None or not isinstance(statement, ast.Expr):
            return None
        modules.add(module)
        if all(s is statement or _sleeps(s) for s in block_of(module, statement)):
            splices.append(module.text.swap(statement, "pass"))
        else:
            splices += map(module.text.without, rows)
    return case.changed(modules.pop(), *splices) if len(modules) == 1 else None


def _sleeps(statement: ast.stmt) -> bool:
    call = statement.value if isinstance(statement, ast.Expr) else None
    return isinstance(call, ast.Call) and ast.unparse(call.func).endswith("sleep")


def into_constructor(case: Case) -> Files | None:
    """Move the only line that creates a timer from its callback to the end of __init__."""
    found = _statement(case)
    init = case.node.method("__init__") if case.node is not None else None
    if found is None or init is None or not found[0].has(init):
        return None
    module, statement, rows = found
    last = init.body[-1]
    names = {n.id for n in ast.walk(statement) if isinstance(n, ast.Name)}
    alone = len(rows) == 1 and len(block_of(module, statement)) > 1
    if names != {"self"} or not alone or isinstance(last, ast.Return) or last.lineno == init.lineno:
        return None
    text = module.text
    row = indent_of(text.line(last.lineno)) + text.line(statement.lineno).strip()
    return case.changed(
        module,
        text.before((last.end_lineno or last.lineno) + 1, row),
        text.without(statement.lineno),
    )


def without_question(case: Case) -> Files | None:
    """Delete the statement of the callback that only asks with input(): nothing uses its answer."""
    found, node = _statement(case), case.node
    if found is None or node is None or case.finding.params.get("name") != "input()":
        return None
    module, statement, rows = found
    if not isinstance(statement, ast.Expr | ast.Assign) or not isinstance(
        statement.value, ast.Call
    ):
        return None
    kept = {name for name in targets_of(statement) if isinstance(statement, ast.Assign)}
    used = {dotted(n) for n in node.all_nodes if isinstance(getattr(n, "ctx", None), ast.Load)}
    alone = len(block_of(module, statement)) == 1
    asks = dotted(statement.value.func) == "input"
    if kept & used or alone or not asks:
        return None
    return case.changed(module, *map(module.text.without, rows))
