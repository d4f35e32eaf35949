"""A change of a piece of a node's file."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.package.edit.text import Splice
from grader.package.source.module import Module


@dataclass(frozen=True)
class Change:
    """A change: of which sort, at which piece, what is written there, and what instead of it."""

    sort: str
    at: ast.stmt | ast.expr
    name: str
    written: str
    splices: tuple[Splice, ...]
    form: str = ""


def of_piece(
    module: Module, sort: str, node: ast.stmt | ast.expr, new: str, form: str = ""
) -> Change:
    """Return the change of a piece of syntax."""
    return Change(sort, node, module.text.code(node), new, (module.text.swap(node, new),), form)
