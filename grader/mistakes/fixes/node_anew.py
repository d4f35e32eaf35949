"""Fixes of an object that a callback makes anew in each call."""

from __future__ import annotations

import ast

from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.lines import own_lines
from grader.mistakes.fixes.uses import places_of
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.source.counter import targets_of
from grader.package.source.made_anew import made_anew
from grader.package.source.node import NodeSource
from grader.package.source.place import place_of


def attribute_for(source: NodeSource, name: str) -> str:
    """Return the attribute that can keep what a variable of the callback has; an attribute itself."""
    if name.startswith("self."):
        return name
    taken = source.attributes | set(source.methods)
    return f"self.{name}_" if name in taken else f"self.{name}"


def is_set_before(source: NodeSource, name: str) -> bool:
    """Return whether __init__ sets an attribute."""
    init = source.method("__init__")
    return init is not None and any(name in targets_of(n) for n in init.body)


def once(case: Case) -> Files | None:
    """Make the object once in __init__, and keep it in an attribute."""
    node = case.node
    found = made_anew(node) if node is not None else None
    init = node.method("__init__") if node is not None else None
    last = node.super_init if node is not None else None
    if node is None or found is None or node.callback is None:
        return None
    module, text = node.module_of(found.made), node.module_of(found.made).text
    lines = own_lines(module, found.made)
    if lines is None or place_of(node, found.made).line != case.finding.line:
        return None
    gone = [text.without(n) for n in lines]
    attribute = attribute_for(node, found.name)
    if not found.is_local and is_set_before(node, found.name):
        return case.changed(module, *gone)
    if init is None or last is None or not module.has(init) or attribute.endswith("__"):
        return None
    if text.line(last.lineno).strip() != text.code(last):
        return None
    row = f"{indent_of(text.line(last.lineno))}{attribute} = {text.code(found.made.value)}"
    new = text.before((last.end_lineno or last.lineno) + 1, row)
    if not found.is_local:
        return case.changed(module, *gone, new)
    places = places_of(module, [node.callback], found.name)
    if places is None or _is_parameter(node.callback, found.name):
        return None
    start, end = text.span(found.made)
    rest = [at for at in places if not start <= at < end]
    swaps = [Splice(at, at + len(found.name), attribute) for at in rest]
    return case.changed(module, *gone, new, *swaps)


def _is_parameter(function: ast.AST, name: str) -> bool:
    return any(isinstance(n, ast.arg) and n.arg == name for n in ast.walk(function))
