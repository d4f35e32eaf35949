"""Parts of a program, as the facts of a run ask about them."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from grader.package.source.module import Module
from grader.package.source.names import dotted
from grader.package.source.place import block_of


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


def compared_with_itself(module: Module, statement: ast.Assign) -> ast.expr | None:
    """Return a later difference or comparison of what a line sets, self.a = b, with b.

    It is below the line in the same block, with nothing that sets one of them in between.
    """
    kept, value = dotted(statement.targets[0]), dotted(statement.value)
    block = block_of(module, statement)
    if not kept.startswith("self.") or not value:
        return None
    for later in block[block.index(statement) + 1 :]:
        for node in ast.walk(later):
            left, right = (dotted(one) if one else "" for one in _sides(node))
            for one, other in ((kept, value), (value, kept)):
                if _behind(left, one) is not None and _behind(left, one) == _behind(right, other):
                    assert isinstance(node, ast.expr)
                    return node
        if {kept, value} & {dotted(n) for n in ast.walk(later) if _is_set(n)}:
            break
    return None


def _sides(node: ast.AST) -> tuple[ast.expr | None, ast.expr | None]:
    """Return the two values of a difference or of a comparison."""
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Sub):
        return node.left, node.right
    return (node.left, node.comparators[0]) if isinstance(node, ast.Compare) else (None, None)


def _behind(name: str, root: str) -> str | None:
    """Return what of a name comes behind its root: `.x` of `pose.x`; None if it has another one."""
    is_of = name == root or name.startswith(f"{root}.")
    return name.removeprefix(root) if is_of else None


def _is_set(node: ast.AST) -> bool:
    return isinstance(node, ast.Name | ast.Attribute) and isinstance(node.ctx, ast.Store)
