"""Fixes of the call of the logger: its method, and what get_logger gets."""

from __future__ import annotations

import ast

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice
from grader.package.source.module import Module
from grader.package.source.names import calls_in, last_part


def call_of(module: Module, line: int | None, method: str) -> ast.Call | None:
    """Return the only call of a method on a line of the file that gets an argument."""
    found = [
        call
        for call, name in calls_in(module.tree)
        if last_part(name) == method
        and (call.args or call.keywords)
        and call.lineno <= (line or 0) <= (call.end_lineno or call.lineno)
    ]
    return found[0] if len(found) == 1 else None


def is_statement(module: Module, call: ast.Call) -> bool:
    """Return whether nothing uses what a call returns."""
    return isinstance(module.parents.get(call), ast.Expr)


def info(case: Case) -> Files | None:
    """Call the method info of the logger instead of one that does not exist."""
    module, name = case.module, str(case.finding.params.get("name", ""))
    call = call_of(module, case.finding.line, name) if module is not None else None
    if module is None or call is None or len(call.args) != 1 or call.keywords:
        return None
    end = module.text.span(call.func)[1]
    written = module.text.text[end - len(name) : end] == name
    return case.changed(module, Splice(end - len(name), end, "info")) if written else None


def given_to_info(case: Case) -> Files | None:
    """Give the text to info, or leave the () of get_logger empty if they have only a name."""
    module = case.module
    call = call_of(module, case.finding.line, "get_logger") if module is not None else None
    if module is None or call is None or len(call.args) != 1 or call.keywords:
        return None
    end = module.text.span(call.func)[1]
    if is_statement(module, call):
        return case.changed(module, Splice(end, end, "().info"))
    return case.changed(module, Splice(end, module.text.span(call)[1], "()"))
