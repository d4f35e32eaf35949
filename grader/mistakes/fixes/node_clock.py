"""The fix of a line that shows the time of a clock instead of a count."""

from __future__ import annotations

import ast

from grader.mistakes.fixes.case import Case
from grader.mistakes.placeholders import COUNTER, as_sum
from grader.package.edit.files import Files
from grader.package.edit.text import indent_of
from grader.package.source.counter import adds_to, starts_of
from grader.package.source.names import dotted
from grader.package.source.node import NodeSource


def count_of(node: NodeSource) -> tuple[str, bool]:
    """Return the attribute that can count, and whether the callback adds to it already.

    That is one that __init__ sets to a number, else a new one.
    """
    names = [name for name in starts_of(node) if name.startswith("self.")]
    parts = list(ast.walk(node.callback)) if node.callback is not None else []
    added = [name for name in names if any(adds_to(part, name) for part in parts)]
    taken = {f"self.{name}" for name in (*node.attributes, *node.methods)} - set(names)
    new = next(n for n in (COUNTER, f"{COUNTER}_", "self.number_of_calls") if n not in taken)
    return (*added, *names, new)[0], bool(added)


def count_for_time(case: Case) -> Files | None:
    """Log a counter instead of the time, set it in __init__, and add to it below the log."""
    node = case.node
    call, callback = (node.log_call, node.callback) if node else (None, None)
    base = node.super_init if node else None
    if node is None or call is None or callback is None or base is None:
        return None
    module, output = node.module_of(call), case.assignment.output
    text, line = module.text, call.lineno
    counter, counts = count_of(node)
    alone = module.line(line) == text.code(call) and call.end_lineno == line
    first = module.line(base.lineno) == text.code(base) and module.has(base)
    if not alone or not first or call not in ast.walk(callback) or callback not in node.own_methods:
        return None
    splices = [text.swap(call.args[0], as_sum(output, counter))]
    splices += [text.without(row) for row in _rows_of_time(node, callback, call)]
    if not counts:
        indent = indent_of(text.line(line))
        splices.append(text.before(line + 1, f"{indent}{counter} += {output.step}"))
    if counter not in starts_of(node):
        indent = indent_of(text.line(base.lineno))
        splices.append(text.before(base.lineno + 1, f"{indent}{counter} = {output.start}"))
    return case.changed(module, *splices)


def _rows_of_time(node: NodeSource, callback: ast.AST, call: ast.Call) -> list[int]:
    """Return the lines that only give the logged text its variables."""
    rows: list[int] = []
    module = node.module_of(call)
    used = {dotted(n) for n in ast.walk(call.args[0])} - {""}
    for part in ast.walk(callback):
        if not isinstance(part, ast.Assign) or part.lineno != part.end_lineno:
            continue
        names = [n.id for n in part.targets if isinstance(n, ast.Name) and n.id in used]
        read = [
            n
            for n in ast.walk(callback)
            if isinstance(n, ast.Name) and n.id in names and isinstance(n.ctx, ast.Load)
        ]
        only = all(n in ast.walk(call) for n in read) and len(names) == len(part.targets) == 1
        if only and module.line(part.lineno) == module.text.code(part):
            rows.append(part.lineno)
    return rows
