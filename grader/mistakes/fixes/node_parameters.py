"""Fixes of parameters that are read and not declared."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.course.assignment import Assignment
from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.lines import own_lines
from grader.package.edit.files import Files
from grader.package.edit.text import indent_of
from grader.package.source.counter import logged_counter, targets_of
from grader.package.source.declared import Parameter, is_period, read
from grader.package.source.module import Module
from grader.package.source.names import called_name, dotted
from grader.package.source.node import NodeSource
from grader.package.source.place import statement_at

OF_TYPE = {"double_value": "0.0", "integer_value": "0", "string_value": "''", "bool_value": "False"}


@dataclass(frozen=True)
class Declaration:
    """The line that declares a parameter, and the statement above which it belongs."""

    written: str
    above: ast.stmt
    is_certain: bool
    in_place: bool


def reading(source: NodeSource, module: Module, name: str, line: int | None) -> Parameter | None:
    """Return the call of get_parameter for a parameter in the statement at a line."""
    statement = statement_at(module, line)
    inside = set(ast.walk(statement)) if statement is not None else set()
    found = [p for p in read(source) if p.name == name and p.call in inside]
    return found[0] if found else None


def declaration(
    source: NodeSource, assignment: Assignment, module: Module, parameter: Parameter
) -> Declaration | None:
    """Return how and where a parameter is declared that is read."""
    call, function = parameter.call, source.function_around(parameter.call)
    statement = statement_at(module, call.lineno)
    init = source.methods.get("__init__")
    if not isinstance(call.func, ast.Attribute) or statement is None or function is None:
        return None
    once = function in (init, source.main)
    if not once:
        if init is None or not init.body or source.super_init is None:
            return None
        after = [s for s in init.body if s.lineno > source.super_init.lineno]
        if not after or not module.has(init):
            return None
        statement = after[0]
    elif not any(statement in block for block in (function.body,)):
        return None  # (in a condition or a loop)
    value = _value(source, assignment, call)
    default = value or OF_TYPE.get(_type_read(module, call), "…")
    owner, text = module.text.code(call.func.value), module.text.code(parameter.written)
    written = f"{owner}.declare_parameter({text}, {default})"
    return Declaration(written, statement, bool(value), once)


def _value(source: NodeSource, assignment: Assignment, call: ast.Call) -> str:
    """Return the default value that is right for certain: of the period, or of the counter."""
    if any(is_period(source, timer, call) for timer in source.timers):
        plain = [t for t in source.timers if t.period is not None and is_period(source, t, call)]
        names = (ast.Name, ast.Attribute, ast.Call)
        if all(isinstance(timer.period, names) for timer in plain):
            return assignment.seconds
    logged = logged_counter(source)
    for node in source.own_nodes:
        if not isinstance(node, ast.Assign) or isinstance(node.value, ast.BinOp):
            continue
        of_counter = logged is not None and logged[1] in targets_of(node)
        if of_counter and any(part is call for part in ast.walk(node.value)):
            return str(assignment.output.start)
    return ""


def _type_read(module: Module, call: ast.Call) -> str:
    """Return double_value of get_parameter('…').get_parameter_value().double_value."""
    around = [n.attr for n in module.around(call) if isinstance(n, ast.Attribute)]
    return next((name for name in around if name in OF_TYPE), "")


def declared_above(case: Case) -> Files | None:
    """Declare the parameter above the line that reads it, if its default value is certain."""
    module, line, node = case.module, case.finding.line, case.node
    name = str(case.finding.params.get("parameter", ""))
    parameter = reading(node, module, name, line) if node and module else None
    if node is None or module is None or parameter is None or case.finding.params.get("late"):
        return None
    found = declaration(node, case.assignment, module, parameter)
    if found is None or not found.is_certain:
        return None
    text = module.text
    row = text.line(found.above.lineno)
    if not row.strip().startswith(text.code(found.above).splitlines()[0]):
        return None
    return case.changed(module, text.before(found.above.lineno, f"{indent_of(row)}{found.written}"))


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
