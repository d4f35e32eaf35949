"""Fixes of words, signs and options that mean something else in Python or in rclpy."""

from __future__ import annotations

import ast
import re

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice
from grader.package.source.counter import logged_counter, targets_of
from grader.package.source.module import Function
from grader.package.source.names import dotted, last_part
from grader.package.source.node import NodeSource

COMPUTED = (ast.BinOp, ast.UnaryOp, ast.Compare)


def word(case: Case) -> Files | None:
    """Write a word of another language as Python does."""
    module = case.module
    name, close = (str(case.finding.params.get(key, "")) for key in ("name", "close"))
    if module is None or not close.isidentifier() or name in module.names:
        return None
    uses = [n for n in module.nodes if isinstance(n, ast.Name) and n.id == name]
    if any(module.text.code(use) != name for use in uses):
        return None
    return case.changed(module, *(module.text.swap(use, close) for use in uses))


def comment(case: Case) -> Files | None:
    """Begin a comment with # instead of //."""
    module, line = case.module, case.finding.line or 0
    name = str(case.finding.params.get("name", ""))
    row = module.text.line(line) if module is not None else ""
    if module is None or not re.search(rf"//\s*{re.escape(name)}\s*\Z", row):
        return None
    at = module.text.start_of(line) + row.rindex("//")
    return case.changed(module, Splice(at, at + 2, "#"))


def lost_sum(source: NodeSource) -> tuple[ast.Expr | ast.Return, str] | None:
    """Return the statement of the callback that computes with the counter and keeps nothing."""
    logged = logged_counter(source)
    if source.callback is None or logged is None:
        return None
    for node in ast.walk(source.callback):
        value = node.value if isinstance(node, ast.Expr) else None
        used = {dotted(part) for part in ast.walk(value)} if isinstance(value, COMPUTED) else set()
        if isinstance(node, ast.Expr) and logged[1] in used:
            return node, logged[1]
    return _returned_sum(source, source.callback, logged[1])


def _returned_sum(
    source: NodeSource, callback: Function, counter: str
) -> tuple[ast.Return, str] | None:
    """Return the last line of the callback if it returns the counter plus a number.

    Nothing but a timer may call the callback: other code could keep what it gets.
    """
    last = callback.body[-1]
    value = last.value if isinstance(last, ast.Return) else None
    if not isinstance(last, ast.Return) or not isinstance(value, ast.BinOp):
        return None
    parts = {dotted(value.left), dotted(value.right)}
    number = isinstance(value.left, ast.Constant) or isinstance(value.right, ast.Constant)
    only_timer = callback.name in {timer.method for timer in source.timers}
    called = any(last_part(name) == callback.name for _, name in source.calls)
    changed = any(counter in targets_of(node) for node in ast.walk(callback))
    if not isinstance(value.op, ast.Add) or counter not in parts or not number:
        return None
    return (last, counter) if only_timer and not called and not changed else None


def kept_sum(case: Case) -> Files | None:
    """Add to the counter on the line that only computes."""
    node = case.node
    found = lost_sum(node) if node is not None else None
    if node is None or found is None:
        return None
    module = node.module_of(found[0])
    new = f"{found[1]} += {case.assignment.output.step}"
    return case.changed(module, module.text.swap(found[0], new))
