"""The fixes of an import of the package's own code."""

from __future__ import annotations

import ast

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
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
