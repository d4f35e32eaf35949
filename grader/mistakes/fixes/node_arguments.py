"""Fixes of arguments: a comma in a number, one argument too many, names that do not exist."""

from __future__ import annotations

import ast
import re

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice
from grader.package.source.names import dotted
from grader.package.source.node import NodeSource

COMMA = re.compile(r"(\d{1,9})[ \t]{0,9},[ \t]{0,9}(\d{1,9})")


def with_comma(source: NodeSource, call: ast.Call) -> tuple[str, str] | None:
    """Return a timer's period that is written with a comma, as it is and with a point."""
    if len(call.args) < 3 or not all(_is_number(given) for given in call.args[:2]):
        return None
    text = source.module_of(call).text
    match = COMMA.fullmatch(text.text[text.span(call.args[0])[0] : text.span(call.args[1])[1]])
    return (match[0], f"{match[1]}.{match[2]}") if match is not None else None


def _is_number(given: ast.expr) -> bool:
    return isinstance(given, ast.Constant) and type(given.value) is int


def decimal_point(case: Case) -> Files | None:
    """Write the period of the timer with a point."""
    node = case.node
    call = node.timer_call if node is not None else None
    found = with_comma(node, call) if node is not None and call is not None else None
    if node is None or call is None or found is None:
        return None
    module = node.module_of(call)
    start, end = module.text.span(call.args[0])[0], module.text.span(call.args[1])[1]
    return case.changed(module, Splice(start, end, found[1]))


def without_names(case: Case) -> Files | None:
    """Pass the period and the callback to create_timer without names."""
    node = case.node
    call = node.timer_call if node is not None else None
    values = [given.value for given in call.keywords] if call is not None else []
    if node is None or call is None or call.args or len(values) != 2:
        return None
    number = isinstance(values[0], ast.Constant) and type(values[0].value) in (int, float)
    if not number or not dotted(values[1]).startswith("self."):
        return None
    module = node.module_of(call)
    splices = []
    for given in call.keywords:
        start = module.text.span(given)[0]
        splices.append(Splice(start, module.text.span(given.value)[0], ""))
    return case.changed(module, *splices)


def without_option(case: Case) -> Files | None:
    """Remove an option that the logger does not have."""
    node = case.node
    call = node.log_call if node is not None else None
    if node is None or call is None or len(call.keywords) != 1:
        return None
    if call.keywords[0].arg != case.finding.params.get("name"):
        return None
    module = node.module_of(call)
    start, end = module.text.span(call.args[0])[1], module.text.span(call.keywords[0])[1]
    return case.changed(module, Splice(start, end, ""))


def only_name(case: Case) -> Files | None:
    """Pass only the node's name to super().__init__(), if the error is about a constructor."""
    said = f"{case.finding.actual} {case.finding.params}"
    node = case.node if "__init__" in said else None
    owner = re.search(r"TypeError: (\w+)\.__init__\(\)", said)
    if node is not None and owner is not None and owner[1] not in {"Node", *node.class_names}:
        return None
    call = node.super_init if node is not None else None
    if node is None or call is None or dotted(call.func) != "super().__init__":
        return None
    module = node.module_of(call)
    end = module.text.span(call)[1] - 1
    return case.changed(
        module,
        Splice(module.text.span(call.func)[1] + 1, end, repr(case.assignment.node_name)),
    )
