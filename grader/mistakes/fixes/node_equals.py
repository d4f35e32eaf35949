"""Fix of a line that compares with `==` where it was to assign a value."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice
from grader.package.source.module import Module
from grader.package.source.names import dotted


@dataclass(frozen=True)
class Compared:
    """A statement `name == value`."""

    statement: ast.Expr
    left: ast.expr
    right: ast.expr
    name: str

    @property
    def lines(self) -> range:
        """The lines of the statement."""
        return range(self.statement.lineno, (self.statement.end_lineno or 0) + 1)

    def written(self, module: Module) -> str:
        """Return the code with one `=`; what is longer than a line ends with dots."""
        left, right = module.text.code(self.left), module.text.code(self.right)
        return f"{left} = {right}" if "\n" not in right and len(right) < 80 else f"{left} = …"


def compared_in(module: Module) -> list[Compared]:
    """Return the statements of a file that only compare two values with `==`, in order."""
    found = []
    for node in module.nodes:
        value = node.value if isinstance(node, ast.Expr) else None
        if not isinstance(node, ast.Expr) or not isinstance(value, ast.Compare):
            continue
        if len(value.ops) == 1 and isinstance(value.ops[0], ast.Eq):
            name = dotted(value.left)
            found += [Compared(node, value.left, value.comparators[0], name)] if name else []
    return sorted(found, key=lambda one: one.statement.lineno)


def assigned(case: Case) -> Files | None:
    """Write = instead of == on the line of the finding."""
    module, line = case.module, case.finding.line
    found = [c for c in compared_in(module) if c.statement.lineno == line] if module else []
    if module is None or len(found) != 1:
        return None
    start, end = module.text.span(found[0].left)[1], module.text.span(found[0].right)[0]
    between = module.text.text[start:end]
    if between.strip() != "==":
        return None
    return case.changed(module, Splice(start, end, between.replace("==", "=")))
