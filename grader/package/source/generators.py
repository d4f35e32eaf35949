"""Generators: functions with yield."""

from __future__ import annotations

import ast
from typing import TypeGuard

from grader.package.source.counter import targets_of
from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted

NO_PLAIN = (
    ast.YieldFrom,
    ast.Await,
    ast.Global,
    ast.Nonlocal,
    ast.Try,
    ast.With,
    ast.For,
    ast.Break,
    ast.Continue,
)


def is_plain_generator(found: ast.AST) -> TypeGuard[Function]:
    """Whether a generator gives the same values whenever it is asked: it uses only its own variables."""
    if not isinstance(found, Function):
        return False
    for node in ast.walk(found):
        if isinstance(node, NO_PLAIN) or (isinstance(node, Function) and node is not found):
            return False
        if isinstance(node, ast.Attribute) or any("." in name for name in targets_of(node)):
            return False
        if isinstance(node, ast.Yield) and isinstance(node.value, ast.Yield):
            return False
    return all(dotted(call.func) in ("str", "int", "range") for call, _ in calls_in(found))
