"""Advice on a node's source: what could be better, but does not prevent the node from working."""

from __future__ import annotations

import ast
from collections.abc import Mapping

from grader.base.i18n.message import Message, Value, joined, say
from grader.base.nearest import compared, nearest
from grader.package.source.guard import called_on_import, is_guard
from grader.package.source.names import dotted

GUARD = "__main__"


def hints(tree: ast.Module, function: str = "main") -> list[str]:
    """Return advice on a source file; `function` is that of the entry point."""
    found: list[str] = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Compare) and dotted(node.left) == "__name__":
            found += _guard(node)
        elif isinstance(node, ast.Expr) and dotted(node.value) == "rclpy.shutdown":
            found.append(_advice("node.shutdown_not_called", node.lineno))
    found += _below_guard(tree, function)
    call = called_on_import(tree, function)
    if call is not None:
        found.append(_advice("node.main_at_import", call.lineno, {"name": function}))
    return found


def _below_guard(tree: ast.Module, function: str) -> list[str]:
    """Return advice on a guard that does not call the function, or that is inside of it."""
    values: Mapping[str, Value] = {"name": function}
    found: list[str] = []
    for statement in tree.body:
        if is_guard(statement) and isinstance(statement, ast.If):
            named = (n for n in statement.body if isinstance(n, ast.Expr))
            lines = [n.lineno for n in named if dotted(n.value) == function]
            found += [_advice("node.guard_without_call", line, values) for line in lines]
        if isinstance(statement, ast.FunctionDef) and statement.name == function:
            inside = [n for n in statement.body if is_guard(n) and _calls(n, function)]
            found += [_advice("node.guard_inside", n.lineno, values) for n in inside]
    return found


def _calls(statement: ast.stmt, function: str) -> bool:
    calls = (n for n in ast.walk(statement) if isinstance(n, ast.Call))
    return any(dotted(call.func) == function for call in calls)


def _guard(node: ast.Compare) -> list[str]:
    (other, *_) = node.comparators
    text = other.value if isinstance(other, ast.Constant) else None
    if not isinstance(text, str) or text == GUARD or not nearest(GUARD, [text], cutoff=0.5):
        return []
    return [joined(_advice("node.guard_misspelt", node.lineno), compared(text, GUARD), by="\n")]


def _advice(mistake: str, line: int, values: Mapping[str, Value] | None = None) -> Message:
    from grader.mistakes.catalogue import CATALOGUE  # noqa: PLC0415 - slow, rarely needed

    kind = CATALOGUE[mistake]
    title = say("line {line}: {code}", line=line, code=Message(kind.title))
    return joined(joined(title, kind.rationale(values or {}), by=". "), kind.fix_text(values or {}))
