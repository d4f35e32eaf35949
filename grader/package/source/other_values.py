"""The first value of a counter, if it is something else than a plain number."""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping
from dataclasses import dataclass

from grader.package.source.counter import adds_to, logged_counter, parts_of_callback, targets_of
from grader.package.source.module import Module
from grader.package.source.names import dotted
from grader.package.source.node import NodeSource

ARRAYS = ("zeros", "ones", "array", "arange", "empty", "full", "linspace", "asarray")
TIMES = ("now", "today", "utcnow", "datetime", "date", "timedelta")
SHAPES: Mapping[str, str] = {
    "array": r"\[.*\]",
    "list": r"\[.*\]",
    "tuple": r"\(.*\)",
    "dict": r"\{.*\}",
    "set": r"\{.*\}|set\(\)",
    "complex": r"\(?-?[\d.+-]+j\)?",
    "time": r"\d{4}-\d\d-\d\d.*|(?:-?\d+ days?, )?\d+:\d\d:\d\d.*",
    "decimal": r"\d+\.\d*(?:E[+-]\d+)?",
}
"""How the text of a value looks, by its sort."""
ELEMENT = re.compile(r"-?\d+\.\d*")


@dataclass(frozen=True)
class OtherValue:
    """A statement that makes a counter of another sort than a number.

    `element` is the part of it that is logged, as `self.n[0]`; None if the whole is logged. `others`
    are the statements that change the counter in another way than adding to it.
    """

    module: Module
    name: str
    start: ast.Assign | ast.AnnAssign
    sort: str
    element: ast.Subscript | None
    others: list[ast.stmt]


def other_value(source: NodeSource, shown: str) -> OtherValue | None:
    """Return the value that is logged as the counter, if the text in its place has the form of it."""
    logged = logged_counter(source)
    if logged is None:
        return None
    call, name = logged
    parts = parts_of_callback(source)
    in_callback = {n for part in parts for n in ast.walk(part)}
    found = [
        node
        for node in source.own_nodes
        if isinstance(node, ast.Assign | ast.AnnAssign)
        and name in targets_of(node)
        and not adds_to(node, name)
    ]
    if len(found) != 1 or found[0] in in_callback or found[0].value is None:
        return None
    start = found[0]
    sort = _sort_of(start.value)
    elements = [
        n for n in ast.walk(call) if isinstance(n, ast.Subscript) and dotted(n.value) == name
    ]
    others = [
        node for node in in_callback if isinstance(node, ast.stmt) and _changes_part(node, name)
    ]
    module = source.module_of(start)
    if sort == "array" and len(elements) == 1 and ELEMENT.fullmatch(shown):
        return OtherValue(module, name, start, sort, elements[0], others)
    if not sort or elements or not re.fullmatch(SHAPES[sort], shown.strip(), re.S):
        return None
    return OtherValue(module, name, start, sort, None, sorted(others, key=lambda n: n.lineno))


def adds_plainly(node: ast.stmt, name: str) -> bool:
    """Whether a statement adds something to the counter as a whole: `n += 1`, `n = n + 1`."""
    if isinstance(node, ast.AugAssign):
        return dotted(node.target) == name
    value = node.value if isinstance(node, ast.Assign) and name in targets_of(node) else None
    return isinstance(value, ast.BinOp) and name in (dotted(value.left), dotted(value.right))


def _changes_part(node: ast.stmt, name: str) -> bool:
    """Whether a statement changes an element, or calls a method: `n[0] += 1`, `n.append(1)`."""
    targets: list[ast.expr] = []
    if isinstance(node, ast.Assign):
        targets = node.targets
    elif isinstance(node, ast.AugAssign):
        targets = [node.target]
    if any(isinstance(t, ast.Subscript) and dotted(t.value) == name for t in targets):
        return True
    if isinstance(node, ast.Assign) and name in targets_of(node):
        return not adds_plainly(node, name)
    call = node.value if isinstance(node, ast.Expr) else None
    return isinstance(call, ast.Call) and dotted(call.func).startswith(f"{name}.")


def _sort_of(value: ast.expr | None) -> str:
    if isinstance(value, ast.Constant):
        return "complex" if isinstance(value.value, complex) else ""
    shapes: list[tuple[type[ast.expr] | tuple[type[ast.expr], ...], str]] = [
        ((ast.List, ast.ListComp), "list"),
        (ast.Tuple, "tuple"),
        ((ast.Dict, ast.DictComp), "dict"),
        ((ast.Set, ast.SetComp), "set"),
    ]
    for kinds, sort in shapes:
        if isinstance(value, kinds):
            return sort
    if not isinstance(value, ast.Call):
        return ""
    owner, _, last = dotted(value.func).rpartition(".")
    if last in ARRAYS and owner in ("np", "numpy", ""):
        return "array"
    if last in TIMES and "clock" not in owner:
        return "time"
    if last in ("Decimal", "Fraction"):
        return "decimal"
    return last if last in ("list", "tuple", "dict", "set", "complex") and not owner else ""
