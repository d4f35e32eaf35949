"""Fixes of what functions return and take: a decorator, a property, a method."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.source.module import Function, Module
from grader.package.source.names import dotted


def lacking(module: Module, decorator: ast.expr) -> Iterator[Function]:
    """Yield the functions behind a decorator that define a function and return nothing."""
    name = dotted(decorator.func) if isinstance(decorator, ast.Call) else dotted(decorator)
    function = module.functions.get(name)
    if function is None:
        return
    if not _returns(function):
        yield function
    elif isinstance(decorator, ast.Call):
        inner = inner_of(function)
        if inner is not None and inner_of(inner) is not None and not _returns(inner):
            yield inner


def inner_of(function: Function) -> Function | None:
    """Return the only function that a function defines."""
    found = [s for s in function.body if isinstance(s, Function)]
    return found[0] if len(found) == 1 else None


def _returns(function: Function) -> bool:
    """Whether a function itself has a return with a value, or a yield."""
    waiting: list[ast.AST] = list(function.body)
    for part in waiting:
        if isinstance(part, Function | ast.Lambda | ast.ClassDef):
            continue
        if isinstance(part, ast.Yield | ast.YieldFrom):
            return True
        if isinstance(part, ast.Return) and part.value is not None:
            return True
        waiting.extend(ast.iter_child_nodes(part))
    return False


def returned(case: Case) -> Files | None:
    """Let the decorator return the function that it defines."""
    module, line = case.module, case.finding.line
    found = [n for n in module.nodes if isinstance(n, Function)] if module is not None else []
    function = next((f for f in found if f.lineno == line), None)
    inner = inner_of(function) if function is not None else None
    if module is None or function is None or inner is None or function.body[-1] is not inner:
        return None
    text = module.text
    row = f"{indent_of(text.line(inner.lineno))}return {inner.name}"
    return case.changed(module, text.before((inner.end_lineno or inner.lineno) + 1, row))


def without_parameter(case: Case) -> Files | None:
    """Remove a parameter, which nothing uses, from the def of a method."""
    module, params = case.module, case.finding.params
    name, method = str(params.get("name", "")), str(params.get("method", ""))
    node = case.node
    if module is None or node is None or not params.get("unused"):
        return None
    found = node.method(method)
    if found is None or not module.has(found) or len(found.args.args) < 2:
        return None
    at = next((n for n, a in enumerate(found.args.args) if a.arg == name), 0)
    if at < 1 or found.args.defaults:
        return None
    text = module.text
    start, end = text.span(found.args.args[at - 1])[1], text.span(found.args.args[at])[1]
    return case.changed(module, Splice(start, end, ""))
