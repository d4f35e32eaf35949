"""The fixes of an import of the package's own code."""

from __future__ import annotations

import ast

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import indent_of
from grader.package.source.node import read_module
from grader.package.source.place import statement_at


def through_package(case: Case) -> Files | None:
    """Write the import with the package's name, if it binds the same names as before."""
    module = read_module(case.files.data, case.finding.file)
    name, new = (str(case.finding.params.get(key, "")) for key in ("name", "written"))
    statement = statement_at(module, case.finding.line) if module is not None else None
    if module is None or statement is None or not new or module.text.code(statement) != name:
        return None
    if isinstance(statement, ast.Import) and not new.startswith("import "):
        whole = {
            g.name.partition(".")[0] for g in statement.names if "." in g.name and not g.asname
        }
        if any(isinstance(n, ast.Name) and n.id in whole for n in module.nodes):
            return None  # (the code uses the whole name)
    return case.changed(module, module.text.swap(statement, new))


def read_in_module(case: Case) -> Files | None:
    """Import the module of a variable instead of the variable, and read the variable in it."""
    module = read_module(case.files.data, case.finding.file)
    name, new = (str(case.finding.params.get(key, "")) for key in ("name", "written"))
    statement = statement_at(module, case.finding.line) if module is not None else None
    if module is None or not isinstance(statement, ast.ImportFrom) or not statement.module:
        return None
    text, dots = module.text, "." * statement.level
    row = text.line(statement.lineno)
    if row.strip() != text.code(statement) or not new:
        return None
    around, _, inner = statement.module.rpartition(".")
    other = [
        f"{alias.name} as {alias.asname}" if alias.asname else alias.name
        for alias in statement.names
        if (alias.asname or alias.name) != name
    ]
    uses = [n for n in module.nodes if isinstance(n, ast.Name) and n.id == name]
    if not all(isinstance(n.ctx, ast.Load) for n in uses) or not (around or dots):
        return None
    rows = [f"from {dots}{around} import {inner}"]
    if other:
        rows.append(f"from {dots}{statement.module} import {', '.join(other)}")
    indented = f"{text.newline}{indent_of(row)}".join(rows)
    swaps = [text.swap(use, new) for use in uses]
    return case.changed(module, text.swap(statement, indented), *swaps)
