"""The function, the statement and the block at a line of a file."""

from __future__ import annotations

import ast

from grader.package.source.module import Function, Module
from grader.package.source.node import NodeSource
from grader.report.model import Where


def place_of(source: NodeSource, node: ast.stmt | ast.expr | None) -> Where:
    """Return the file and the line of a piece of syntax; the class's file for None."""
    if node is None:
        return Where(file=source.module.path)
    return Where(file=source.module_of(node).path, line=node.lineno)


def function_at(module: Module, line: int | None) -> Function | None:
    """Return the innermost function with a line of the file; None if there is none."""
    found = [n for n in module.nodes if isinstance(n, Function) and _has(n, line)]
    return max(found, key=lambda node: node.lineno, default=None)


def statement_at(module: Module, line: int | None) -> ast.stmt | None:
    """Return the innermost statement with a line of the file; None if there is none."""
    found = [n for n in module.nodes if isinstance(n, ast.stmt) and _has(n, line)]
    return max(found, key=lambda node: (node.lineno, node.col_offset), default=None)


def _has(node: ast.stmt, line: int | None) -> bool:
    return node.lineno <= (line or 0) <= (node.end_lineno or node.lineno)


def first_row(node: ast.stmt) -> int:
    """Return the first line of a statement: that of its first decorator, if it has one."""
    decorators: list[ast.expr] = getattr(node, "decorator_list", [])
    return min([node.lineno, *(decorator.lineno for decorator in decorators)])


def last_row(node: ast.stmt) -> int:
    """Return the last line of a statement; of a block, of its head."""
    block = getattr(node, "body", None)
    return max(node.lineno, block[0].lineno - 1) if block else node.end_lineno or node.lineno


def statement_of(module: Module, part: ast.AST) -> ast.stmt:
    """Return the innermost statement that a part of the file is in."""
    return next(n for n in (part, *module.around(part)) if isinstance(n, ast.stmt))


def owns_lines(module: Module, node: ast.stmt) -> bool:
    """Whether no other code is on the lines of a statement."""
    text = module.text
    start, end = text.span(node)
    before = text.text[text.start_of(node.lineno) : start]
    after = text.text[end : text.end_of(node.end_lineno or node.lineno)].strip()
    return not before.strip() and (not after or after.startswith("#"))


def block_of(module: Module, statement: ast.stmt) -> list[ast.stmt]:
    """Return the list of statements that has a statement."""
    around = module.parents.get(statement, module.tree)
    for name in ("body", "orelse", "finalbody"):
        block = getattr(around, name, None)
        if isinstance(block, list) and statement in block:
            return block
    return [statement]


def method_above(module: Module, line: int) -> Function | None:
    """Return the method of a class whose lines end last before a line."""
    methods = [s for c in module.classes for s in c.body if isinstance(s, Function)]
    above = [m for m in methods if (m.end_lineno or m.lineno) < line]
    return max(above, key=lambda node: node.lineno, default=None)
