"""Fixes of what the node logs."""

from __future__ import annotations

import ast
from difflib import SequenceMatcher

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice
from grader.package.source.module import Module
from grader.package.source.names import called_name, dotted
from grader.package.source.node import NodeSource
from grader.package.source.place import statement_at

ALIKE = 0.7


def text(case: Case) -> Files | None:
    """Correct the only string that is nearly the required text before the number."""
    node, wanted = case.node, case.assignment.output.text.partition("{n}")[0]
    if node is None or "'" in wanted or '"' in wanted or not wanted.strip():
        return None
    strings = [n for n in node.own_nodes if isinstance(n, ast.Constant)]
    found = [n for n in strings if _near(node.module_of(n).text.plain_string(n) or "", wanted)]
    if len(found) != 1:
        return None
    code = node.module_of(found[0]).text
    quote = code.code(found[0])[0]
    return case.changed(node.module_of(found[0]), code.swap(found[0], f"{quote}{wanted}{quote}"))


def _near(found: str, wanted: str) -> bool:
    ratio = SequenceMatcher(None, found.lower(), wanted.lower(), autojunk=False).ratio()
    return found != wanted and len(found) <= 2 * len(wanted) and ratio >= ALIKE


def text_outside(
    node: NodeSource, module: Module, line: int | None
) -> tuple[ast.Call, ast.expr] | None:
    """Return the call of the logger or of print at a line, and what is written behind its bracket."""
    statement = statement_at(module, line)
    after = statement.value if isinstance(statement, ast.Expr) else None
    part: ast.expr | None = after
    while part is not None:
        if isinstance(part, ast.Call) and (node.is_log(part) or dotted(part.func) == "print"):
            return (part, after) if after is not None and part is not after else None
        if isinstance(part, ast.BinOp) and isinstance(part.op, ast.Add | ast.Mod):
            part = part.left
        elif isinstance(part, ast.Call) and isinstance(part.func, ast.Attribute):
            part = part.func.value
        else:
            return None
    return None


def text_inside(module: Module, call: ast.Call, after: ast.expr) -> str | None:
    """Return the call with what is behind it in its brackets; None if it can mean something else."""
    given = call.args[0] if len(call.args) == 1 and not call.keywords else None
    if given is None or not isinstance(given, ast.Constant | ast.JoinedStr):
        return None
    text = module.text
    start, end = text.span(after)
    close, last = text.span(call)[1] - 1, text.span(given)[1]
    if text.span(call)[0] != start or text.text[last:close].strip():
        return None
    number = isinstance(after, ast.BinOp) and isinstance(after.op, ast.Add) and after.right
    if number and isinstance(number, ast.Name | ast.Attribute):
        end = text.span(number)[0]
        return f"{text.text[start:last]}{text.text[close + 1 : end]}str({text.code(number)}))"
    return f"{text.text[start:last]}{text.text[close + 1 : end]})"


def moved_inside(case: Case) -> Files | None:
    """Write what is behind the closing bracket of the logger into its brackets."""
    node, module = case.node, case.module
    found = text_outside(node, module, case.finding.line) if node and module else None
    if module is None or found is None:
        return None
    new = text_inside(module, *found)
    return case.changed(module, module.text.swap(found[1], new)) if new is not None else None


def level(case: Case) -> Files | None:
    """Log at level INFO."""
    node = case.node
    call = node.log_call if node else None
    if node is None or call is None or called_name(call) == "info":
        return None
    module = node.module_of(call)
    end = module.text.span(call.func)[1]
    return case.changed(module, Splice(end - len(called_name(call)), end, "info"))
