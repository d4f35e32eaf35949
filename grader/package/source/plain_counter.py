"""Whether a counter is certainly a plain number, and where it gets its first value."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass

from grader.package.source.counter import starts_of, targets_of
from grader.package.source.names import dotted, last_part
from grader.package.source.node import NodeSource

OF_OBJECTS = ("len", "next", "iter", "sum", "list", "enumerate", "getattr", "setattr", "partial")


@dataclass(frozen=True)
class PlainStart:
    """The number with which a counter starts, and where the source writes it."""

    at: ast.expr
    number: float


def plain_start(source: NodeSource, name: str) -> PlainStart | None:
    """Return the first value of a counter that is a plain number; None if this is not certain.

    It starts with a literal, and nothing uses it as an object: no attribute, element or call of it.
    """
    if not name or last_part(name) in source.methods or _is_object(source, name):
        return None
    literal = starts_of(source).get(name) or starts_of(source, float).get(name)
    if literal is not None and isinstance(literal.value, int | float):
        return PlainStart(literal, literal.value)
    found = list(_negatives(source, name))
    return found[0] if len(found) == 1 else None


def _negatives(source: NodeSource, name: str) -> Iterator[PlainStart]:
    for node in source.own_nodes:
        value = node.value if isinstance(node, ast.Assign | ast.AnnAssign) else None
        if not isinstance(value, ast.UnaryOp) or not isinstance(value.op, ast.USub):
            continue
        number = value.operand.value if isinstance(value.operand, ast.Constant) else None
        if name in targets_of(node) and type(number) in (int, float):
            yield PlainStart(value, -float(str(number)))


def _is_object(source: NodeSource, name: str) -> bool:
    for node in source.own_nodes:
        if isinstance(node, ast.Subscript | ast.Attribute) and dotted(node.value) == name:
            return True
        if not isinstance(node, ast.Call):
            continue
        if dotted(node.func) == name:
            return True
        if dotted(node.func) in OF_OBJECTS and name in map(dotted, node.args):
            return True
    return False
