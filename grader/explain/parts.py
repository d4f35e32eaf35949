"""Parts of a program, as the facts of a run ask about them."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from grader.package.source.names import dotted


def rows_of(part: ast.stmt) -> range:
    """Return the lines of a statement."""
    return range(part.lineno, (part.end_lineno or part.lineno) + 1)


def read_in(node: ast.AST) -> Iterator[str]:
    """Yield the names that a part of a program reads: those of attributes of self, and plain ones."""
    for part in ast.walk(node):
        if isinstance(part, ast.Name | ast.Attribute) and isinstance(part.ctx, ast.Load):
            name = dotted(part)
            if name:
                yield name
