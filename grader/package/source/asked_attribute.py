"""Conditions that ask for an attribute of the node which nothing sets."""

from __future__ import annotations

import ast

from grader.base.nearest import nearest
from grader.package.source.names import dotted, own_name
from grader.package.source.node import NodeSource


def never_there(source: NodeSource, test: ast.expr) -> str | None:
    """Return the attribute that a condition asks for, if it is met because nothing ever sets it.

    `not hasattr(self, 'count')`, `hasattr(self, 'count') == False` and `getattr(self, 'count', None)
    is None`, where the file sets only a similar name such as `self.count_`. None for a name that the
    node may have from elsewhere.
    """
    asked = _asked(test)
    if asked is None:
        return None
    found = [n for n in source.own_nodes if isinstance(n, ast.Attribute)]
    set_here = {n.attr for n in found if own_name(n) and isinstance(n.ctx, ast.Store)}
    known = {n.attr for n in found} | set(source.methods) | source.module.names
    by_name = any(
        (isinstance(n, ast.Call) and dotted(n.func) in ("setattr", "vars"))
        or (isinstance(n, ast.Attribute) and n.attr in ("__dict__", "__setattr__"))
        for n in source.own_nodes
    )  # fmt: skip
    if by_name or asked in known:
        return None
    name = asked.removeprefix("self.")
    if name != asked:
        return asked if name in set_here else None  # (no attribute has a name with a dot)
    alike = {n.strip("_").lower() for n in set_here}
    return asked if asked.strip("_").lower() in alike or nearest(asked, set_here, 0.8) else None


def _asked(test: ast.expr) -> str | None:
    call: ast.expr | None = None
    if isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
        call = test.operand
    elif isinstance(test, ast.Compare) and len(test.ops) == 1:
        with_none = isinstance(test.comparators[0], ast.Constant)
        value = test.comparators[0].value if isinstance(test.comparators[0], ast.Constant) else 0
        same = isinstance(test.ops[0], ast.Is | ast.Eq) and with_none
        call = test.left if same and (value is None or value is False) else None
    if not isinstance(call, ast.Call) or len(call.args) < 2 or dotted(call.args[0]) != "self":
        return None
    name = call.args[1].value if isinstance(call.args[1], ast.Constant) else None
    if not isinstance(name, str):
        return None
    if dotted(call.func) == "hasattr":
        return name if not isinstance(test, ast.Compare) or _is(test, value=False) else None
    without = len(call.args) == 3 and isinstance(call.args[2], ast.Constant)
    default = call.args[2].value if without and isinstance(call.args[2], ast.Constant) else 1
    met = not default if isinstance(test, ast.UnaryOp) else default is None and _is(test, None)
    return name if dotted(call.func) == "getattr" and without and met else None


def _is(test: ast.expr, value: object) -> bool:
    given = test.comparators[0] if isinstance(test, ast.Compare) else None
    return isinstance(given, ast.Constant) and given.value is value
