"""Fixes that change the line of the finding, whatever it contains."""

from __future__ import annotations

import ast
import re

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice
from grader.package.source.module import Module, is_text
from grader.package.source.place import block_of


def _statement(case: Case) -> tuple[Module, ast.stmt] | None:
    """Return the file and the only statement that begins on the finding's line."""
    module, line = case.module, case.finding.line
    found = (
        [n for n in module.nodes if isinstance(n, ast.stmt) and n.lineno == line] if module else []
    )
    return (module, found[0]) if module is not None and len(found) == 1 else None


def own_lines(module: Module, statement: ast.stmt) -> range | None:
    """Return the lines of a statement; None if something else than a comment is on one of them."""
    last = statement.end_lineno or statement.lineno
    written = "\n".join(module.text.line(n) for n in range(statement.lineno, last + 1)).strip()
    code = module.text.code(statement).replace(module.text.newline, "\n")
    rest = written.removeprefix(code).lstrip()
    alone = written.startswith(code) and (not rest or rest.startswith("#"))
    return range(statement.lineno, last + 1) if alone else None


def deleted(case: Case) -> Files | None:
    """Delete the statement of the finding, if its block has others.

    An `if` that has no other statement is deleted too.
    """
    found = _statement(case)
    if found is None:
        return None
    module, statement = found
    while len(block_of(module, statement)) == 1:
        around = module.parents.get(statement)
        if not isinstance(around, ast.If) or around.orelse:
            return None
        statement = around
    lines = own_lines(module, statement)
    others = [s for s in block_of(module, statement) if s is not statement]
    if lines is None or not any(not is_text(s) for s in others):
        return None
    return case.changed(module, *(module.text.without(n) for n in lines))


def written(case: Case) -> Files | None:
    """Write the code that the finding gives instead of the code that it names, on its line."""
    module, line = case.module, case.finding.line
    name, new = (str(case.finding.params.get(key, "")) for key in ("name", "written"))
    row = module.text.line(line) if module is not None and line else ""
    edge = [r"(?<!\w)" if name[:1].isalnum() else "", r"(?!\w)" if name[-1:].isalnum() else ""]
    places = list(re.finditer(re.escape(name).join(edge), row)) if name and new else []
    if module is None or line is None or len(places) != 1:
        return None
    start = module.text.start_of(line)
    return case.changed(module, Splice(start + places[0].start(), start + places[0].end(), new))


def unwrapped(case: Case) -> Files | None:
    """Write what the finding's `with` uses as a statement of its own, and its block below it."""
    module, found = _statement(case) or (None, None)
    if module is None or not isinstance(found, ast.With) or len(found.items) != 1:
        return None
    text, item, first = module.text, found.items[0], found.body[0]
    long = [n for n in ast.walk(found) if isinstance(n, ast.Constant | ast.JoinedStr)]
    if item.context_expr.end_lineno != found.lineno or first.lineno == found.lineno:
        return None
    if any(n.lineno != n.end_lineno for n in long):
        return None  # (its later lines are a text, whose blanks stay)
    head = text.code(item.context_expr)
    if item.optional_vars is not None:
        head = f"{text.code(item.optional_vars)} = {head}"
    start = text.start_of(found.lineno) + found.col_offset
    splices = [Splice(start, text.start_of(found.lineno) + len(text.line(found.lineno)), head)]
    for row in range(found.lineno + 1, (found.end_lineno or 0) + 1):
        begin, line = text.start_of(row), text.line(row)
        extra = min(first.col_offset - found.col_offset, len(line) - len(line.lstrip()))
        splices += [Splice(begin, begin + extra, "")]
    return case.changed(module, *splices)
