"""Fixes of a method that creates the timer, and that nothing calls."""

from __future__ import annotations

import ast

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import indent_of


def called(case: Case) -> Files | None:
    """Call the method at the end of __init__."""
    node, module = case.node, case.module
    name = str(case.finding.params.get("name", ""))
    init = node.method("__init__") if node is not None else None
    method = node.method(name) if node is not None and name else None
    if node is None or module is None or init is None or method is None or not module.has(init):
        return None
    last = init.body[-1]
    plain = ast.unparse(method.args) == "self" and not method.decorator_list
    if not plain or isinstance(last, ast.Return) or last.lineno == init.lineno:
        return None
    if any(isinstance(n, ast.Attribute) and n.attr == name for n in module.nodes):
        return None
    row = f"{indent_of(module.text.line(init.body[0].lineno))}self.{name}()"
    return case.changed(module, module.text.before((last.end_lineno or last.lineno) + 1, row))
