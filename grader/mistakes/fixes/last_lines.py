"""Fixes of the lines below spin."""

from __future__ import annotations

import ast

from grader.mistakes.fixes import lines
from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.source.place import block_of, statement_at


def without_wait(case: Case) -> Files | None:
    """Delete the line that waits, if nothing uses its value, or the loop that only waits."""
    module, line = case.module, case.finding.line
    statement = statement_at(module, line) if module is not None else None
    if module is None or statement is None:
        return None
    loop = module.parents.get(statement)
    if isinstance(statement, ast.While) or not isinstance(loop, ast.While | ast.For):
        loop = statement if isinstance(statement, ast.While) else None
    if loop is None:
        return lines.deleted(case) if isinstance(statement, ast.Expr) else None
    rows = lines.own_lines(module, loop)
    plain = all(isinstance(s, ast.Expr | ast.Pass) for s in loop.body)
    outer = isinstance(module.parents.get(loop), ast.While | ast.For)
    if rows is None or outer or not plain or loop.orelse or len(block_of(module, loop)) == 1:
        return None
    return case.changed(module, *(module.text.without(row) for row in rows))
