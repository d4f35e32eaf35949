"""Fixes of parameters that are read and not declared."""

from __future__ import annotations

import ast

from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.lines import own_lines
from grader.package.edit.files import Files
from grader.package.source.counter import targets_of
from grader.package.source.declared import Parameter, read
from grader.package.source.module import Module
from grader.package.source.names import called_name, dotted
from grader.package.source.node import NodeSource
from grader.package.source.place import statement_at


def reading(source: NodeSource, module: Module, name: str, line: int | None) -> Parameter | None:
    """Return the call of get_parameter for a parameter in the statement at a line."""
    statement = statement_at(module, line)
    inside = set(ast.walk(statement)) if statement is not None else set()
    found = [p for p in read(source) if p.name == name and p.call in inside]
    return found[0] if found else None


def moved_up(case: Case) -> Files | None:
    """Move the line that declares the parameter above the line that reads it."""
    module, line, late = case.module, case.finding.line, case.finding.params.get("late")
    above = statement_at(module, line) if module is not None else None
    declares = statement_at(module, int(late)) if module is not None and late else None
    if module is None or above is None or declares is None or case.node is None:
        return None
    function = case.node.function_around(above)
    if function is None or above not in function.body or declares not in function.body:
        return None
    value = declares.value if isinstance(declares, ast.Expr) else None
    if not isinstance(value, ast.Call) or called_name(value) not in (
        "declare_parameter",
        "declare_parameters",
    ):
        return None
    names = {dotted(n) for given in value.args[1:] for n in ast.walk(given)} - {""}
    between = [s for s in function.body if above.lineno <= s.lineno < declares.lineno]
    if names & {target for s in between for target in targets_of(s)}:
        return None
    rows = own_lines(module, declares)
    if rows is None or own_lines(module, above) is None:
        return None
    text = module.text
    moved = [text.line(number) for number in rows]
    return case.changed(module, *(text.without(n) for n in rows), text.before(above.lineno, *moved))
