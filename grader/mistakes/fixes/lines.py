"""Fixes that change the line of the finding, whatever it contains."""

from __future__ import annotations

import ast
import re

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.source.imported import imports
from grader.package.source.module import Module, is_text
from grader.package.source.place import block_of

BLOCKS = ast.For | ast.While | ast.If


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


def deleted_name(case: Case) -> Files | None:
    """Delete the lines that contain only a name that nothing defines."""
    found = _statement(case)
    value = found[1].value if found is not None and isinstance(found[1], ast.Expr) else None
    name = str(case.finding.params.get("name", ""))
    if case.module is None or not isinstance(value, ast.Name) or value.id != name:
        return None
    text = case.module.text
    rows = [row for row in rows_with_only(case.module, name) if text.line(row).strip() == name]
    return case.changed(case.module, *map(text.without, rows)) if len(rows) > 1 else deleted(case)


def rows_with_only(module: Module, name: str) -> list[int]:
    """Return the lines whose statement is only a name."""
    statements = [n for n in module.nodes if isinstance(n, ast.Expr)]
    return sorted(
        s.lineno for s in statements if isinstance(s.value, ast.Name) and s.value.id == name
    )


def unwrapped(case: Case) -> Files | None:
    """Remove the loop or the condition of the finding, and keep its lines."""
    module, line = case.module, case.finding.line
    found = (
        [n for n in module.nodes if isinstance(n, BLOCKS) and n.lineno == line] if module else []
    )
    if module is None or len(found) != 1 or found[0].orelse or case.finding.params.get("number"):
        return None  # (without the loop there is no such number)
    block, first = found[0], found[0].body[0].lineno
    if first == block.lineno or module.text.line(first - 1).strip() == "":
        return None
    bound = (
        {
            n.id
            for n in ast.walk(block.target)
            if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)
        }
        if isinstance(block, ast.For)
        else set()
    )
    inside = [n for s in block.body for n in ast.walk(s)]
    if any(isinstance(n, ast.Break | ast.Continue) for n in inside):
        return None
    if any(isinstance(n, ast.Name) and n.id in bound for n in inside):
        return None
    text = module.text
    old, new = indent_of(text.line(first)), indent_of(text.line(block.lineno))
    splices = [text.without(n) for n in range(block.lineno, first)]
    for number in range(first, (block.end_lineno or first) + 1):
        row = text.line(number)
        if row.strip() and not row.startswith(old):
            return None
        start = text.start_of(number)
        splices += [Splice(start, start + len(old), new)] if row.strip() else []
    return case.changed(module, *splices)


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


def without_import(case: Case, name: str) -> Files:
    """Delete the import of a module that the node's file does not use any more."""
    module = case.node.module if case.node is not None else None
    if module is None:
        return case.files
    for bound, full, statement in imports(module):
        used = any(isinstance(n, ast.Name) and n.id == bound for n in module.nodes)
        alone = len(getattr(statement, "names", ())) == 1
        if full.partition(".")[0] == name and alone and not used:
            if module.line(statement.lineno) != module.text.code(statement):
                return case.files
            return case.changed(module, module.text.without(statement.lineno)) or case.files
    return case.files
