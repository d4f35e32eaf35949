"""Fixes of a name that has nearly its right letters."""

from __future__ import annotations

import ast
import re
from collections.abc import Sequence

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice
from grader.package.source.module import Function, Module
from grader.package.source.names import dotted


def def_renamed(module: Module, function: Function, new: str) -> Splice | None:
    """Return the splice that gives a function another name where it is defined; None if it is async."""
    at = module.text.at(function.lineno, function.col_offset) + len("def ")
    end = at + len(function.name)
    return Splice(at, end, new) if module.text.text[at:end] == function.name else None


def splices_of(
    module: Module, parts: Sequence[ast.Name | ast.Attribute], new: str
) -> list[Splice] | None:
    """Return the splices that give parts of a file another last name; None if one is not found.

    Before Python 3.12 the places of what is in an f-string can be wrong.
    """
    splices = []
    for part in parts:
        old = part.id if isinstance(part, ast.Name) else part.attr
        start, end = module.text.span(part)
        code = module.text.text[start:end]
        if not re.search(rf"(?<!\w){re.escape(old)}\Z", code):
            return None
        splices.append(Splice(end - len(old), end, new))
    return splices


def _names(module: Module, name: str) -> list[ast.Name]:
    return [n for n in module.nodes if isinstance(n, ast.Name) and n.id == name]


def variable(case: Case) -> Files | None:
    """Write the known name instead of the one that nothing defines."""
    name, close = _misspelt(case)
    module = case.module
    if module is None or not name or name in module.names:
        return None
    found = _names(module, name)
    splices = splices_of(module, found, close)
    return case.changed(module, *splices) if splices else None


def attribute(case: Case) -> Files | None:
    """Write the known attribute instead of the one that the object does not have."""
    name, close = _misspelt(case)
    module, node = case.module, case.node
    if module is None or node is None or not name or name in node.methods:
        return None
    found = [n for n in module.nodes if isinstance(n, ast.Attribute) and n.attr == name]
    objects = {dotted(part.value) for part in found}
    if len(objects) != 1 or not _is_one_line_of(case, module, found):
        return None
    splices = splices_of(module, found, close)
    return case.changed(module, *splices) if splices else None


def _is_one_line_of(case: Case, module: Module, found: Sequence[ast.expr]) -> bool:
    """Whether the line of the finding is one of those that have the name."""
    lines = {n for part in found for n in range(part.lineno, (part.end_lineno or 0) + 1)}
    return (
        case.finding.line is None or case.finding.line in lines or module.path != case.finding.file
    )


def imported(case: Case) -> Files | None:
    """Import a module, or a name of a module, by its right name."""
    name, close = _misspelt(case)
    module = case.module
    if module is None or not name:
        return None
    splices: list[Splice] = []
    for statement in module.nodes:
        if isinstance(statement, ast.Import | ast.ImportFrom):
            of_import = _in_import(module, statement, name, close)
            if of_import is None:
                return None
            splices += of_import
    return case.changed(module, *splices) if splices else None


def _in_import(
    module: Module, statement: ast.Import | ast.ImportFrom, name: str, close: str
) -> list[Splice] | None:
    """Return the splices in a line that imports, and in the uses of what it binds."""
    row = module.text.code(statement)
    written = {alias.name for alias in statement.names}
    head = getattr(statement, "module", None) or ""
    if not any(part == name or part.startswith(f"{name}.") for part in (*written, head)):
        return []
    pattern = rf"(?<![\w.]){re.escape(name)}(?!\w)"
    if len(re.findall(pattern, row)) != 1:
        return None
    start, _ = module.text.span(statement)
    match = re.search(pattern, row)
    at = start + (match.start() if match else 0)
    splices = [Splice(at, at + len(name), close)]
    bound = {alias.asname or alias.name for alias in statement.names}
    uses = _names(module, name) if name in bound and not _names(module, close) else []
    own = [c for c in module.classes if c.name == name]
    if own:  # (the uses below the class mean the class)
        uses = [use for use in uses if use.lineno <= own[0].lineno]
    if any(isinstance(use.ctx, ast.Store) for use in uses):
        return None
    of_uses = splices_of(module, uses, close)
    return None if of_uses is None else [*splices, *of_uses]


def _misspelt(case: Case) -> tuple[str, str]:
    """Return the wrong and the right name of the finding; two empty texts if it has no right one."""
    params = case.finding.params
    name, close = str(params.get("name", "")), str(params.get("close", ""))
    certain = close.isidentifier() or all(part.isidentifier() for part in close.split("."))
    return (name, close) if name and close and certain else ("", "")
