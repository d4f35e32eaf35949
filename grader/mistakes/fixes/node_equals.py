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
    """A statement `name == value`, or `name: type == value`."""

    statement: ast.Expr | ast.AnnAssign
    left: ast.expr
    right: ast.expr
    name: str

    @property
    def lines(self) -> range:
        """The lines of the statement."""
        return range(self.statement.lineno, (self.statement.end_lineno or 0) + 1)

    def written(self, module: Module) -> str:
        """Return the code with one `=`; what is longer than a line ends with dots."""
        start, end = module.text.span(self.statement)
        left = module.text.text[start : module.text.span(self.left)[1]]
        right = module.text.code(self.right)
        return f"{left} = {right}" if "\n" not in right and end - start < 100 else f"{left} = …"


def compared_in(module: Module) -> list[Compared]:
    """Return the statements of a file that only compare two values with `==`, in order."""
    found = []
    for node in module.nodes:
        value: ast.expr | None = None
        if isinstance(node, ast.Expr):
            value = node.value
        elif isinstance(node, ast.AnnAssign) and node.value is None:
            value = node.annotation
        if not isinstance(node, ast.Expr | ast.AnnAssign) or not isinstance(value, ast.Compare):
            continue
        if len(value.ops) == 1 and isinstance(value.ops[0], ast.Eq):
            name = dotted(value.left if isinstance(node, ast.Expr) else node.target)
            found += [Compared(node, value.left, value.comparators[0], name)] if name else []
    return sorted(found, key=lambda one: one.statement.lineno)


def arrows_in(module: Module) -> list[Compared]:
    """Return the statements `name <- value`, which compare a value with a negative one."""
    found = []
    for node in module.nodes:
        value = node.value if isinstance(node, ast.Expr) else None
        if not isinstance(node, ast.Expr) or not isinstance(value, ast.Compare):
            continue
        right, name = value.comparators[0], dotted(value.left)
        less = len(value.ops) == 1 and isinstance(value.ops[0], ast.Lt)
        if name and less and isinstance(right, ast.UnaryOp) and isinstance(right.op, ast.USub):
            found.append(Compared(node, value.left, right.operand, name))
    return found


def assigned(case: Case) -> Files | None:
    """Write = instead of == or <- on the line of the finding, and self. before a name that needs it."""
    module, name = case.module, str(case.finding.params.get("name", ""))
    found = (
        [
            c
            for c in (*compared_in(module), *arrows_in(module))
            if c.statement.lineno == case.finding.line
        ]
        if module
        else []
    )
    if module is None or len(found) != 1 or found[0].name != name:
        return None
    text, one = module.text, found[0]
    start, end = text.span(one.left)[1], text.span(one.right)[0]
    between = text.text[start:end]
    sign = between.strip()
    if sign not in ("==", "<-"):
        return None
    at = text.span(one.statement)[0]
    own = str(case.finding.params.get("written", "")).startswith(f"self.{name} ")
    dot = [Splice(at, at, "self.")] if own else []
    return case.changed(module, *dot, Splice(start, end, between.replace(sign, "=")))
