"""A change of a piece of a node's file, and the pieces that add to a counter."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from grader.package.edit.text import Splice
from grader.package.source.counter import targets_of
from grader.package.source.module import Module
from grader.package.source.names import dotted

SUM = ast.Add | ast.Sub


@dataclass(frozen=True)
class Change:
    """A change: of which sort, at which piece, what is written there, and what instead of it."""

    sort: str
    at: ast.stmt | ast.expr
    name: str
    written: str
    splices: tuple[Splice, ...]
    form: str = ""


@dataclass(frozen=True)
class Wanted:
    """The lines that the node has to log, and its counter's first value and step."""

    lines: Sequence[str]
    start: int
    step: int


def of_piece(
    module: Module, sort: str, node: ast.stmt | ast.expr, new: str, form: str = ""
) -> Change:
    """Return the change of a piece of syntax."""
    return Change(sort, node, module.text.code(node), new, (module.text.swap(node, new),), form)


def additions(module: Module) -> Iterator[ast.AugAssign | ast.Assign]:
    """Yield the statements that add to a name, or take from it."""
    for node in module.nodes:
        if isinstance(node, ast.AugAssign) and isinstance(node.op, SUM):
            yield node
        elif isinstance(node, ast.Assign) and isinstance(node.value, ast.BinOp):
            name = dotted(node.value.left)
            if name and name in set(targets_of(node)):
                yield node
