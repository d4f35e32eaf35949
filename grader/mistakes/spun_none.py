"""Why rclpy.spin gets None: the function that makes the node does not return it."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.mistakes.fixes.case import Case
from grader.mistakes.recognised import Raised
from grader.package.edit.files import Files
from grader.package.edit.text import indent_of
from grader.package.source.counter import targets_of
from grader.package.source.module import Function, Module
from grader.package.source.names import dotted, last_part
from grader.package.source.node import NodeSource, read_module
from grader.package.source.place import function_at

MAKES = ("create_node", "Node")


@dataclass(frozen=True)
class NotReturned:
    """A function whose value is used as the node, and that returns nothing."""

    used: ast.Assign
    function: Function
    variable: str  # (the only variable of the function that has a node)


def not_returned(raised: Raised, name: str) -> NotReturned | None:
    """Return the function whose missing value is what a name has on the line of the error."""
    function = function_at(raised.module, raised.line)
    for _ in range(3):
        names = [a.arg for a in function.args.args] if function is not None else []
        if function is None or name not in names:
            break
        function, name = _passed(raised.module, function, names.index(name))
    sets = [n for n in ast.walk(function) if name in targets_of(n)] if function is not None else []
    used = sets[0] if len(sets) == 1 else None
    value = used.value if isinstance(used, ast.Assign) else None
    if not isinstance(used, ast.Assign) or not isinstance(value, ast.Call):
        return None
    made = raised.module.functions.get(dotted(value.func))
    if made is None or _has_value(made) or isinstance(made, ast.AsyncFunctionDef):
        return None
    nodes = [n for n in ast.walk(made) if _makes_node(raised.source, n)]
    variables = [target for n in nodes for target in targets_of(n) if "." not in target]
    return NotReturned(used, made, variables[0] if len(variables) == 1 == len(nodes) else "")


def _passed(module: Module, function: Function, index: int) -> tuple[Function | None, str]:
    """Return the function with the only call of a function, and the name passed at a place."""
    calls = [n for n in module.nodes if isinstance(n, ast.Call) and dotted(n.func) == function.name]
    given = calls[0].args if len(calls) == 1 and module.functions.get(function.name) else []
    name = dotted(given[index]) if len(given) > index else ""
    return (function_at(module, calls[0].lineno), name) if name else (None, "")


def _makes_node(source: NodeSource, part: ast.AST) -> bool:
    value = part.value if isinstance(part, ast.Assign | ast.AnnAssign) else None
    called = value.func if isinstance(value, ast.Call) else None
    known = called is not None and last_part(dotted(called)) in MAKES
    return called is not None and (known or source.is_node_class(called))


def _has_value(function: Function) -> bool:
    """Whether a function returns or yields something, or is changed by a decorator."""
    parts = [n for n in ast.walk(function) if isinstance(n, ast.Return | ast.Yield | ast.YieldFrom)]
    return bool(function.decorator_list) or any(
        not isinstance(n, ast.Return) or n.value is not None for n in parts
    )


def with_return(case: Case) -> Files | None:
    """Write the return of the node as the last line of the function."""
    module, params = read_module(case.files.data, case.finding.file), case.finding.params
    made = module.functions.get(str(params.get("function", ""))) if module is not None else None
    written = str(params.get("written", ""))
    if module is None or made is None or not written or made.body[0].lineno == made.lineno:
        return None
    if any(isinstance(n, ast.Return) for n in ast.walk(made)):
        return None
    row = f"{indent_of(module.text.line(made.body[0].lineno))}{written}"
    return case.changed(module, module.text.before((made.end_lineno or made.lineno) + 1, row))
