"""What to delete if a statement that stops the lines stands in a branch of an if."""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence

from grader.base.i18n.message import Value, msg
from grader.mistakes.fixes import lines
from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.source.module import Module
from grader.package.source.names import calls_in, last_part
from grader.package.source.node import NodeSource
from grader.package.source.place import function_at, statement_at

FIXES = {
    "if_block": msg("Delete the if of line {line} with all lines of its block."),
    "elif": msg("Delete the elif of line {line} with all lines of its block."),
    "else_kept": msg(
        "Delete the if of line {line} with all lines of its block, and the line else: below it. Keep the "
        "lines of the else, indented as far as the if is indented now."
    ),
    "if_kept": msg(
        "Delete the line of the if (line {line}), and its else: with all lines of that block. Keep the "
        "other lines of the if, indented as far as the if is indented now."
    ),
}
"""The fixes by the variant. They keep the lines that log, so that these always run."""


def branch_of(
    source: NodeSource, module: Module, statement: ast.stmt | None
) -> tuple[str, ast.If] | None:
    """Return the variant and the if of a statement that has to go; None if it can go alone.

    It cannot if other lines of its branch run only at the end, or if the log is in the other branch.
    """
    around = module.parents.get(statement) if statement is not None else None
    function = function_at(module, statement.lineno) if statement is not None else None
    if statement is None or function is None or not isinstance(around, ast.If):
        return None
    other = around.orelse if statement in around.body else around.body
    logged = len(_logs(source, [function])) > len(_logs(source, [around]))
    if _is_elif(module, around) or any(isinstance(s, ast.If) for s in around.orelse[:1]):
        inside = statement in around.body and _is_elif(module, around)
        return ("elif", around) if inside else None
    if other and _logs(source, other):
        return ("else_kept" if statement in around.body else "if_kept", around)
    if not other and logged and len(around.body) > 1:
        return ("if_block", around)
    return None


def in_branch(
    source: NodeSource, module: Module, statement: ast.stmt | None
) -> tuple[str, Mapping[str, Value]] | None:
    """Return the variant and the words of the texts for `branch_of`."""
    found = branch_of(source, module, statement)
    return (found[0], {"line": str(found[1].lineno)}) if found is not None else None


def _is_elif(module: Module, around: ast.If) -> bool:
    return module.line(around.lineno).lstrip().startswith("elif")


def _logs(source: NodeSource, parts: Sequence[ast.AST]) -> list[ast.Call]:
    """Return the calls that log or call a method which does."""
    found = [call for part in parts for call in source.logs(part)]
    for part in parts:
        for call, name in calls_in(part):
            method = source.methods.get(last_part(name))
            if method is not None and name.startswith("self.") and source.logs(method):
                found.append(call)
    return found


def without_stop(case: Case) -> Files | None:
    """Delete the statement that stops the lines, with the branch that has no other work."""
    module, node = case.module, case.node
    statement = statement_at(module, case.finding.line) if module is not None else None
    if module is None or node is None or statement is None:
        return None
    if any(isinstance(part, ast.ExceptHandler) for part in module.around(statement)):
        return None  # (an error is the cause, and without the stop nothing would show it)
    found = branch_of(node, module, statement)
    if found is None:
        return lines.deleted(case)
    variant, around = found
    own = lines.own_lines(module, around)
    if own is None or around.body[0].lineno == around.lineno:
        return None
    if variant in ("if_block", "elif"):
        last = around.body[-1].end_lineno or around.lineno
        gone = range(around.lineno, last + 1)
        parts = module.parents.get(around)
        alone = variant == "if_block" and getattr(parts, "body", None) == [around]
        return None if alone else case.changed(module, *map(module.text.without, gone))
    kept = around.orelse if variant == "else_kept" else around.body
    return _kept_alone(case, module, around, kept)


def _kept_alone(
    case: Case, module: Module, around: ast.If, kept: Sequence[ast.stmt]
) -> Files | None:
    """Delete an if with its else, but keep the lines of one of its blocks."""
    first, last = kept[0].lineno, kept[-1].end_lineno or kept[-1].lineno
    texts = [n for s in kept for n in ast.walk(s) if isinstance(n, ast.Constant | ast.JoinedStr)]
    if any(n.end_lineno != n.lineno for n in texts) or kept[0].col_offset <= around.col_offset:
        return None
    splices: list[Splice] = []
    new = indent_of(module.text.line(around.lineno))
    old = indent_of(module.text.line(first))
    for number in range(around.lineno, (around.end_lineno or around.lineno) + 1):
        row = module.text.line(number)
        if not first <= number <= last:
            splices.append(module.text.without(number))
        elif row.strip():
            if not row.startswith(old):
                return None
            at = module.text.start_of(number)
            splices.append(Splice(at, at + len(old), new))
    return case.changed(module, *splices)
