"""Fixes of the call that creates the node, and of the constructor that it calls."""

from __future__ import annotations

import ast
import re
from dataclasses import dataclass

from grader.course.assignment import Assignment
from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice
from grader.package.source.counter import starts_of, targets_of
from grader.package.source.module import Module
from grader.package.source.names import dotted, own_name
from grader.package.source.node import NodeSource


@dataclass(frozen=True)
class Wanted:
    """A parameter of the constructor that a call does not pass, and its value if it is known.

    `unused` is whether nothing in the constructor reads it.
    """

    call: ast.Call
    argument: ast.arg
    value: str
    unused: bool


def wanted_by_constructor(
    source: NodeSource, assignment: Assignment, line: int | None, name: str
) -> Wanted | None:
    """Return what the constructor of the node's class wants from the call on a line."""
    init = source.method("__init__")
    calls = [
        call
        for call, _ in source.calls
        if source.is_node_class(call.func) and line in _lines_of(call)
    ]
    if init is None or len(calls) != 1 or init.args.posonlyargs or init.args.vararg:
        return None
    arguments = init.args.args[1:]
    at = next((n for n, given in enumerate(arguments) if given.arg == name), None)
    if at is None or len(calls[0].args) != at or any(k.arg is None for k in calls[0].keywords):
        return None
    reads = [n for n in ast.walk(init) if isinstance(n, ast.Name) and n.id == name]
    quote = source.module_of(calls[0]).text.quote
    value = _value_of(source, assignment, init, name, quote) if reads else ""
    return Wanted(calls[0], arguments[at], value, not reads)


def _lines_of(node: ast.expr) -> range:
    return range(node.lineno, (node.end_lineno or node.lineno) + 1)


def _value_of(
    source: NodeSource, assignment: Assignment, init: ast.FunctionDef, name: str, quote: str
) -> str:
    """Return the value that a parameter needs, by what __init__ does with it; "" if unknown."""
    known = {name}
    for statement in init.body:
        value = statement.value if isinstance(statement, ast.Assign) else None
        if isinstance(value, ast.Name) and value.id in known:
            known |= set(targets_of(statement))
    call = source.super_init
    named = [*(call.args[:1] if call else ()), *_keyword(call, "node_name")]
    by_super = call is not None and dotted(call.func) == "super().__init__"
    if by_super and any(dotted(given) in known for given in named):
        return f"{quote}{assignment.node_name}{quote}"
    if any(dotted(t.period) in known for t in source.timers if t.period is not None):
        return assignment.seconds
    counters = {f"self.{own_name(n)}" for n in _increased(source) if own_name(n)}
    return str(assignment.output.start) if known & counters else ""


def _keyword(call: ast.Call | None, name: str) -> list[ast.expr]:
    return [k.value for k in call.keywords if k.arg == name] if call is not None else []


def _increased(source: NodeSource) -> list[ast.expr]:
    """Return what the callback adds to."""
    callback = source.callback
    found = [n for n in ast.walk(callback) if isinstance(n, ast.AugAssign)] if callback else []
    return [n.target for n in found if f"{dotted(n.target)}" not in starts_of(source)]


def passed(source: NodeSource, wanted: Wanted) -> str:
    """Return the call with the value that it does not pass."""
    text = source.module_of(wanted.call).text
    start, (at, new) = text.span(wanted.call)[0], _inserted(source, wanted)
    code = text.code(wanted.call)
    return code[: at - start] + new + code[at - start :]


def _inserted(source: NodeSource, wanted: Wanted) -> tuple[int, str]:
    """Return where the value belongs in the call, and the text that is inserted there."""
    text, call = source.module_of(wanted.call).text, wanted.call
    if call.args:
        return text.span(call.args[-1])[1], f", {wanted.value}"
    after = text.text[text.span(call.func)[1] : text.span(call)[1]]
    at = text.span(call.func)[1] + after.index("(") + 1
    return at, f"{wanted.value}, " if call.keywords else wanted.value


def argument(case: Case) -> Files | None:
    """Pass the value that the constructor needs; remove a parameter that nothing uses."""
    node, name = case.node, str(case.finding.params.get("name", ""))
    line = int(str(case.finding.params.get("line", "0")) or 0)
    wanted = wanted_by_constructor(node, case.assignment, line, name) if node is not None else None
    if node is None or wanted is None:
        return None
    if wanted.value:
        at, new = _inserted(node, wanted)
        return case.changed(node.module_of(wanted.call), Splice(at, at, new))
    init = node.method("__init__")
    if not wanted.unused or init is None:
        return None
    text = node.module.text
    start, end = text.span(wanted.argument)
    before = re.search(r",\s*\Z", text.text[:start])
    return case.changed(node.module, Splice(before.start(), end, "")) if before else None


def plain_super(case: Case) -> Files | None:
    """Call super() without the name of a class that does not exist."""
    module, line = case.module, case.finding.line
    name = str(case.finding.params.get("name", ""))
    call = super_of(module.nodes, name, line) if module is not None else None
    if module is None or call is None:
        return None
    named = named_node(module, case.node, case.assignment) if case.node is not None else None
    name_too = [module.text.swap(*named)] if named is not None else []
    return case.changed(module, module.text.swap(call, "super()"), *name_too)


def named_node(
    module: Module, source: NodeSource, assignment: Assignment
) -> tuple[ast.Constant, str] | None:
    """Return the literal by which a file names the node, and that of the name that it must have."""
    init = source.super_init
    given = init.args[0] if init is not None and init.args and module.has(init) else None
    if not isinstance(given, ast.Constant) or not isinstance(given.value, str):
        return None
    quote = module.text.code(given)[:1]
    return (given, f"{quote}{assignment.node_name}{quote}") if quote in ("'", '"') else None


def super_of(nodes: list[ast.AST], name: str, line: int | None) -> ast.Call | None:
    """Return the call super(name, self) on a line."""
    for node in nodes:
        if not isinstance(node, ast.Call) or dotted(node.func) != "super" or len(node.args) != 2:
            continue
        if [dotted(given) for given in node.args] == [name, "self"] and node.lineno == line:
            return node
    return None
