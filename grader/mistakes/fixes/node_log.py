"""Fixes of what the node says."""

from __future__ import annotations

import ast
import difflib
import re

from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.node_code import NodeCode
from grader.mistakes.fixes.node_code import called
from grader.mistakes.fixes.node_code import own
from grader.mistakes.fixes.node_code import plain_text
from grader.mistakes.fixes.node_code import read_node
from grader.package.edit.files import Files
from grader.package.edit.text import Splice

PLACE = re.compile(r"\{self\.([A-Za-z_]\w*)\}")
FORMATTED = re.compile(r"(\{self\.\w+)(?:![rsa])?:[^{}]*\}")
ALIKE = 0.7


def f_prefix(case: Case) -> Files | None:
    """Put the f in front of a text with {self.…} in it."""
    code = read_node(case)
    call = code.log_call if code else None
    if code is None or call is None:
        return None
    said = plain_text(code, call.args[0]) or ""
    names = PLACE.findall(said)
    if not names or said.count("{") != len(names) or not set(names) <= set(code.counters()):
        return None
    start = code.source.span(call.args[0])[0]
    return code.changed(Splice(start, start, "f"))


def text(case: Case) -> Files | None:
    """Let the text in front of the number be the one that is asked for, if it is nearly that."""
    code = read_node(case)
    call = code.log_call if code else None
    before, _, after = case.assignment.output.text.partition("{n}")
    if code is None or call is None or after:
        return None
    said = call.args[0]
    if isinstance(said, ast.BinOp) and isinstance(said.op, ast.Add):
        start, end = code.source.span(said.left)[1], code.source.span(said)[1]
        if isinstance(said.left, ast.BinOp) and plain_text(code, said.right):
            return code.changed(Splice(start, end, ""))
        literal = plain_text(code, said.left)
        if literal is None or not _near(literal, before):
            return None
        if isinstance(said.right, ast.Constant | ast.BinOp):
            return None
        quote = code.source.code(said.left)[0]
        return code.changed(code.source.swap(said.left, f"{quote}{before}{quote}"))
    return _formatted(code, said, before)


def _formatted(code: NodeCode, said: ast.expr, before: str) -> Files | None:
    """Fix the text in front of the one place of an f-string."""
    written = code.source.code(said)
    match = re.fullmatch(r"([fF])(['\"])([^{}'\"\\]+)(\{[^{}'\"\\]+\})\2", written)
    if not isinstance(said, ast.JoinedStr) or match is None or not _near(match[3], before):
        return None
    return code.changed(code.source.swap(said, f"{match[1]}{match[2]}{before}{match[4]}{match[2]}"))


def _near(found: str, wanted: str) -> bool:
    if found == wanted or "'" in wanted or '"' in wanted:
        return False
    ratio = difflib.SequenceMatcher(None, found.lower(), wanted.lower(), autojunk=False).ratio()
    return len(found) <= 2 * len(wanted) and ratio >= ALIKE


def logger(case: Case) -> Files | None:
    """Log what is printed, in a method of the node."""
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
    """Log as INFO."""
    code = read_node(case)
    call = code.log_call if code else None
    if code is None or call is None or called(call) == "info":
        return None
    end = code.source.span(call.func)[1]
    return code.changed(Splice(end - len(called(call)), end, "info"))


def logger_call(case: Case) -> Files | None:
    """Write get_logger() with its brackets."""
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
    """Put str() around the counter, where it is added to a text."""
    code = read_node(case)
    call = code.log_call if code else None
    said = call.args[0] if call else None
    if code is None or not isinstance(said, ast.BinOp) or not isinstance(said.op, ast.Add):
        return None
    if own(said.right) not in code.counters() or plain_text(code, said.left) is None:
        return None
    return code.changed(code.source.swap(said.right, f"str({code.source.code(said.right)})"))


def comma(case: Case) -> Files | None:
    """Join text and number with +, where a comma is between them as print would take it."""
    code = read_node(case)
    calls = [c for c in code.calls("info") if "get_logger" in ast.unparse(c)] if code else []
    if code is None or len(calls) != 1 or len(calls[0].args) != 2 or calls[0].keywords:
        return None
    first, second = calls[0].args
    to_text = isinstance(second, ast.Call) and called(second) == "str"
    if plain_text(code, first) is None or not to_text:
        return None
    start, end = code.source.span(first)[1], code.source.span(second)[0]
    if code.source.text[start:end].strip() != ",":
        return None
    return code.changed(Splice(start, end, " + "))


def number(case: Case) -> Files | None:
    """Put the counter behind the text, where only the text is logged."""
    code = read_node(case)
    call = code.log_call if code else None
    before, _, after = case.assignment.output.text.partition("{n}")
    if code is None or call is None or after or len(code.counters()) != 1:
        return None
    if (plain_text(code, call.args[0]) or "").rstrip() != before.rstrip():
        return None
    q = code.source.code(call.args[0])[0]
    counter = next(iter(code.counters()))
    return code.changed(code.source.swap(call.args[0], f"{q}{before}{q} + str(self.{counter})"))


def plain_number(case: Case) -> Files | None:
    """Write the number as it is, without zeros in front of it and without a decimal point."""
    code = read_node(case)
    call = code.log_call if code else None
    if code is None or call is None:
        return None
    said = call.args[0]
    if isinstance(said, ast.JoinedStr):
        new, count = FORMATTED.subn(r"\1}", code.source.code(said))
        return code.changed(code.source.swap(said, new)) if count == 1 else None
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
    """Take away the print() of what is logged too."""
    code = read_node(case)
    call = code.log_call if code else None
    if code is None or call is None:
        return None
    said = code.source.code(call.args[0])
    for method in code.methods:
        for statement in method.body:
            row = code.source.line(statement.lineno).strip()
            if row == f"print({said})" == code.source.code(statement) and len(method.body) > 1:
                return code.changed(code.source.without(statement.lineno))
    return None
