"""Fixes of what the node logs."""

from __future__ import annotations

import ast
import difflib
import re

from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.node_code import NodeCode, called, own, read_node
from grader.package.edit.files import Files
from grader.package.edit.text import Splice

PLACE = re.compile(r"\{self\.([A-Za-z_]\w*)\}")
FORMATTED = re.compile(r"(\{self\.\w+)(?:![rsa])?:[^{}]*\}")
ALIKE = 0.7


def f_prefix(case: Case) -> Files | None:
    """Add the f prefix to a string with {self.…} in it."""
    code = read_node(case)
    call = code.log_call if code else None
    if code is None or call is None:
        return None
    logged = code.source.plain_string(call.args[0]) or ""
    names = PLACE.findall(logged)
    if not names or logged.count("{") != len(names) or not set(names) <= set(code.counters()):
        return None
    start = code.source.span(call.args[0])[0]
    return code.changed(Splice(start, start, "f"))


def text(case: Case) -> Files | None:
    """Correct the text before the number if it is nearly the required one."""
    code = read_node(case)
    call = code.log_call if code else None
    before, _, after = case.assignment.output.text.partition("{n}")
    if code is None or call is None or after:
        return None
    logged = call.args[0]
    if isinstance(logged, ast.BinOp) and isinstance(logged.op, ast.Add):
        start, end = code.source.span(logged.left)[1], code.source.span(logged)[1]
        if isinstance(logged.left, ast.BinOp) and code.source.plain_string(logged.right):
            return code.changed(Splice(start, end, ""))
        literal = code.source.plain_string(logged.left)
        if literal is None or not _near(literal, before):
            return None
        if isinstance(logged.right, ast.Constant | ast.BinOp):
            return None
        quote = code.source.code(logged.left)[0]
        return code.changed(code.source.swap(logged.left, f"{quote}{before}{quote}"))
    return _formatted(code, logged, before)


def _formatted(code: NodeCode, logged: ast.expr, before: str) -> Files | None:
    """Correct the text before the only replacement field of an f-string."""
    written = code.source.code(logged)
    match = re.fullmatch(r"([fF])(['\"])([^{}'\"\\]+)(\{[^{}'\"\\]+\})\2", written)
    if not isinstance(logged, ast.JoinedStr) or match is None or not _near(match[3], before):
        return None
    return code.changed(
        code.source.swap(logged, f"{match[1]}{match[2]}{before}{match[4]}{match[2]}")
    )


def _near(found: str, wanted: str) -> bool:
    if found == wanted or "'" in wanted or '"' in wanted:
        return False
    ratio = difflib.SequenceMatcher(None, found.lower(), wanted.lower(), autojunk=False).ratio()
    return len(found) <= 2 * len(wanted) and ratio >= ALIKE


def logger(case: Case) -> Files | None:
    """Replace print() with the logger in a method of the node."""
    code = read_node(case)
    prints = code.calls("print") if code else []
    if code is None or len(prints) != 1 or len(prints[0].args) != 1 or prints[0].keywords:
        return None
    inside = {id(n) for m in code.methods for n in ast.walk(m) if m.name != "__init__"}
    takes_self = all(m.args.args and m.args.args[0].arg == "self" for m in code.methods)
    if id(prints[0]) not in inside or not takes_self or "get_logger" in code.source.text:
        return None
    return code.changed(code.source.swap(prints[0].func, "self.get_logger().info"))


def level(case: Case) -> Files | None:
    """Log at level INFO."""
    code = read_node(case)
    call = code.log_call if code else None
    if code is None or call is None or called(call) == "info":
        return None
    end = code.source.span(call.func)[1]
    return code.changed(Splice(end - len(called(call)), end, "info"))


def logger_call(case: Case) -> Files | None:
    """Add the missing () to get_logger."""
    code = read_node(case)
    if code is None:
        return None
    splices = []
    for node in ast.walk(code.tree):
        if isinstance(node, ast.Attribute) and own(node.value) == "get_logger":
            end = code.source.span(node.value)[1]
            splices.append(Splice(end, end, "()"))
    return code.changed(*splices)


def number_as_text(case: Case) -> Files | None:
    """Put str() around a counter that is added to a string."""
    code = read_node(case)
    call = code.log_call if code else None
    logged = call.args[0] if call else None
    if code is None or not isinstance(logged, ast.BinOp) or not isinstance(logged.op, ast.Add):
        return None
    if own(logged.right) not in code.counters() or code.source.plain_string(logged.left) is None:
        return None
    return code.changed(code.source.swap(logged.right, f"str({code.source.code(logged.right)})"))


def comma(case: Case) -> Files | None:
    """Join text and number with + instead of a comma, which only print accepts."""
    code = read_node(case)
    calls = [c for c in code.calls("info") if "get_logger" in ast.unparse(c)] if code else []
    if code is None or len(calls) != 1 or len(calls[0].args) != 2 or calls[0].keywords:
        return None
    first, second = calls[0].args
    to_text = isinstance(second, ast.Call) and called(second) == "str"
    if code.source.plain_string(first) is None or not to_text:
        return None
    start, end = code.source.span(first)[1], code.source.span(second)[0]
    if code.source.text[start:end].strip() != ",":
        return None
    return code.changed(Splice(start, end, " + "))


def number(case: Case) -> Files | None:
    """Append the counter if only the text is logged."""
    code = read_node(case)
    call = code.log_call if code else None
    before, _, after = case.assignment.output.text.partition("{n}")
    if code is None or call is None or after or len(code.counters()) != 1:
        return None
    if (code.source.plain_string(call.args[0]) or "").rstrip() != before.rstrip():
        return None
    q = code.source.code(call.args[0])[0]
    counter = next(iter(code.counters()))
    return code.changed(code.source.swap(call.args[0], f"{q}{before}{q} + str(self.{counter})"))


def plain_number(case: Case) -> Files | None:
    """Log the plain number, without leading zeros and without a decimal point."""
    code = read_node(case)
    call = code.log_call if code else None
    if code is None or call is None:
        return None
    logged = call.args[0]
    if isinstance(logged, ast.JoinedStr):
        new, count = FORMATTED.subn(r"\1}", code.source.code(logged))
        return code.changed(code.source.swap(logged, new)) if count == 1 else None
    init = code.method("__init__")
    floats = [
        s.value
        for s in (init.body if init else [])
        if isinstance(s, ast.Assign) and isinstance(s.value, ast.Constant) and own(s.targets[0])
    ]
    floats = [value for value in floats if type(value.value) is float]
    start = case.assignment.output.start
    if len(floats) != 1 or floats[0].value != start:
        return None
    return code.changed(code.source.swap(floats[0], repr(start)))


def only_logged(case: Case) -> Files | None:
    """Remove a print() of the text that is logged as well."""
    code = read_node(case)
    call = code.log_call if code else None
    if code is None or call is None:
        return None
    logged = code.source.code(call.args[0])
    for method in code.methods:
        for statement in method.body:
            row = code.source.line(statement.lineno).strip()
            if row == f"print({logged})" == code.source.code(statement) and len(method.body) > 1:
                return code.changed(code.source.without(statement.lineno))
    return None
