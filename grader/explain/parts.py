"""Parts of a program, as the facts of a run ask about them."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from grader.base.i18n.message import Value
from grader.base.shown import shown
from grader.package.source.module import Function, Module
from grader.package.source.names import dotted


def rows_of(part: ast.stmt) -> range:
    """Return the lines of a statement."""
    return range(part.lineno, (part.end_lineno or part.lineno) + 1)


def branch_of(module: Module, at: ast.stmt) -> dict[str, Value]:
    """Return the condition (`guard`) with which a statement runs, and its line; nothing if it has none."""
    around = next((n for n in module.around(at) if isinstance(n, ast.If | Function)), None)
    if not isinstance(around, ast.If):
        return {}
    test = module.text.code(around.test)
    inside = any(around.body[0].lineno <= at.lineno <= (s.end_lineno or 0) for s in around.body)
    return {"guard": shown(test if inside else f"not ({test})"), "head": around.lineno}


def read_in(node: ast.AST) -> Iterator[str]:
    """Yield the names that a part of a program reads: those of attributes of self, and plain ones."""
    for part in ast.walk(node):
        if isinstance(part, ast.Name | ast.Attribute) and isinstance(part.ctx, ast.Load):
            name = dotted(part)
            if name:
                yield name
