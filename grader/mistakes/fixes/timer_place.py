"""Fixes of where and how often a timer is created."""

from __future__ import annotations

import ast

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import indent_of
from grader.package.source.after_spin import timer_after_spin
from grader.package.source.module import Module


def above_spin(case: Case) -> Files | None:
    """Move the line that creates the timer above the one that spins."""
    found = timer_after_spin(case.node) if case.node is not None else None
    if case.node is None or found is None or found[0].lineno != case.finding.line:
        return None
    module = case.node.module_of(found[0])
    late, spin = (_statement(module, call) for call in found)
    if late is None or spin is None or late.lineno != late.end_lineno:
        return None
    row = indent_of(module.text.line(spin.lineno)) + module.text.line(late.lineno).strip()
    return case.changed(
        module, module.text.before(spin.lineno, row), module.text.without(late.lineno)
    )


def _statement(module: Module, call: ast.Call) -> ast.stmt | None:
    """Return the statement of a call if it is alone on its lines."""
    found = next((n for n in module.around(call) if isinstance(n, ast.stmt)), None)
    if not isinstance(found, ast.Expr | ast.Assign):
        return None
    first = module.text.line(found.lineno).partition("#")[0].strip()
    return found if module.text.code(found).startswith(first) else None
