"""Fixes of lines in the wrong block, and of names without what belongs before or around them."""

from __future__ import annotations

import ast

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.source.module import Function, Module
from grader.package.source.names import called_name, dotted
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of, first_row, function_at, method_above, statement_at


def indented(case: Case) -> Files | None:
    """Indent the lines directly below a method that use self, so that they belong to it."""
    module, line = case.module, case.finding.line or 0
    method = method_above(module, line) if module is not None else None
    statement = statement_at(module, line) if module is not None else None
    if module is None or method is None or statement is None or function_at(module, line):
        return None
    block = block_of(module, statement)
    lines = [s for s in block if s.lineno > method.lineno]
    end = next((n for n, s in enumerate(lines) if isinstance(s, Function | ast.ClassDef)), None)
    lines = lines[:end]
    if not lines or statement not in lines or any(not _uses_self(s) for s in lines):
        return None
    if method.name != "__init__" and any(_starts(s) for s in lines):
        return None
    wanted = indent_of(module.text.line(method.body[-1].lineno))
    splices = []
    for number in range(lines[0].lineno, (lines[-1].end_lineno or 0) + 1):
        row = module.text.line(number)
        old = indent_of(module.text.line(lines[0].lineno))
        if row.strip() and row.startswith(old):
            at = module.text.start_of(number)
            splices.append(Splice(at, at + len(old), wanted))
    return case.changed(module, *splices)


def _uses_self(statement: ast.stmt) -> bool:
    return any(isinstance(n, ast.Name) and n.id == "self" for n in ast.walk(statement))


def _starts(statement: ast.stmt) -> bool:
    """Whether a line belongs in __init__: it creates a timer, or sets an attribute to a literal."""
    if isinstance(statement, ast.Assign) and isinstance(statement.value, ast.Constant):
        return True
    calls = [n for n in ast.walk(statement) if isinstance(n, ast.Call)]
    return any(called_name(call) == "create_timer" for call in calls)


def inner_function(source: NodeSource, name: str) -> Function | None:
    """Return the only function of the entry point's file of a name, if it is not at the margin."""
    module = source.entry
    found = [n for n in module.nodes if isinstance(n, Function) and n.name == name]
    if len(found) != 1 or name in module.functions:
        return None
    around = module.parents.get(found[0])
    return found[0] if isinstance(around, Function | ast.ClassDef) else None


def at_margin(case: Case) -> Files | None:
    """Move the entry function out of the class, if it is the last thing in it."""
    node = case.node
    found = inner_function(node, case.assignment.function) if node is not None else None
    if node is None or found is None or {"self", "cls"} & {a.arg for a in found.args.args}:
        return None
    module = node.entry
    if block_of(module, found)[-1] is not found:
        return None
    above = found.decorator_list
    if any(dotted(d) not in ("staticmethod", "classmethod") for d in above):
        return None
    first = min([found.lineno, *(d.lineno for d in above)])
    uses = uses_of_class(node, found.name)
    if any(first <= use.lineno <= (found.end_lineno or first) for use in uses):
        return None
    named = [module.text.swap(use, found.name) for use in uses]
    for_methods = [module.text.without(d.lineno) for d in above]
    last = found.end_lineno or found.lineno
    return _shifted(case, module, (found.lineno, last), "", *named, *for_methods)


def uses_of_class(source: NodeSource, function: str) -> list[ast.Attribute]:
    """Return the places of the entry's file that name a function through the node's class."""
    names = {f"{name}.{function}" for name in source.class_names}
    return [n for n in source.entry.nodes if isinstance(n, ast.Attribute) and dotted(n) in names]


def _shifted(
    case: Case, module: Module, lines: tuple[int, int], indent: str, *more: Splice
) -> Files | None:
    """Give a block of lines another indentation; None if a line is indented less than the first."""
    old = indent_of(module.text.line(lines[0]))
    splices = list(more)
    for number in range(lines[0], lines[1] + 1):
        row, at = module.text.line(number), module.text.start_of(number)
        if row.strip() and not row.startswith(old):
            return None
        if row.strip():
            splices.append(Splice(at, at + len(old), indent))
    return case.changed(module, *splices)


def out_of_init(case: Case) -> Files | None:
    """Make a method of the function that is the last thing in __init__."""
    node, name = case.node, str(case.finding.params.get("name", ""))
    init = node.method("__init__") if node is not None else None
    last = init.body[-1] if init is not None else None
    if node is None or init is None or not isinstance(last, ast.FunctionDef) or last.name != name:
        return None
    if [a.arg for a in last.args.args][:1] != ["self"] or len(init.body) == 1:
        return None
    module = node.module_of(last)
    first = first_row(last)
    # a comment directly above belongs to it
    while module.line(first - 1).startswith("#") and first - 1 > init.lineno:
        first -= 1
    indent = indent_of(module.text.line(init.lineno))
    return _shifted(case, module, (first, last.end_lineno or first), indent)


def into_class(case: Case) -> Files | None:
    """Indent a method that stands at the margin directly below its class."""
    node = case.node
    name = str(case.finding.params.get("name", ""))
    if node is None or node.node_class is None or name not in node.module.functions:
        return None
    module, function = node.module, node.module.functions[name]
    body = module.tree.body
    above = body[body.index(function) - 1]
    if above is not node.node_class or [a.arg for a in function.args.args][:1] != ["self"]:
        return None
    first = first_row(function)
    indent = indent_of(module.text.line(node.class_body[-1].lineno))
    return _shifted(case, module, (first, function.end_lineno or first), indent)


def self_dot(case: Case) -> Files | None:
    """Put self. before a name that is a method or an attribute of the node."""
    node = case.node
    name = str(case.finding.params.get("name", ""))
    module = case.module
    if node is None or module is None or not name or name in module.names - set(node.methods):
        return None
    uses = [n for n in module.nodes if isinstance(n, ast.Name) and n.id == name]
    splices = []
    for use in uses:
        function = node.function_around(use)
        first = function.args.args[:1] if function is not None else []
        inside = function in node.own_methods and [a.arg for a in first] == ["self"]
        if not inside or not isinstance(use.ctx, ast.Load) or module.text.code(use) != name:
            return None
        at = module.text.span(use)[0]
        splices.append(Splice(at, at, "self."))
    return case.changed(module, *splices)
