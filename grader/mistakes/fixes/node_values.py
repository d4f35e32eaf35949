"""Fixes of what a name stands for."""

from __future__ import annotations

import ast

from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.rename import splices_of
from grader.package.edit.files import Files
from grader.package.source.counter import starts_of
from grader.package.source.module import Module
from grader.package.source.names import dotted


def number_in(start: ast.Constant) -> str:
    """Return the whole number that is written in quotes; "" if it is none."""
    value = start.value if isinstance(start.value, str) else ""
    return str(int(value)) if value.isascii() and value.isdigit() and len(value) < 10 else ""


def appended(module: Module, name: str) -> list[ast.Constant]:
    """Return the numbers in quotes that `+=` appends to a name."""
    values = [
        n.value for n in module.nodes if isinstance(n, ast.AugAssign) and dotted(n.target) == name
    ]
    return [v for v in values if isinstance(v, ast.Constant) and number_in(v)]


def counted_up(module: Module, name: str) -> list[tuple[ast.BinOp, ast.Constant]]:
    """Return the numbers in quotes that `name = name + …` appends to a name, with the sums."""
    found = []
    for node in module.nodes:
        value = node.value if isinstance(node, ast.Assign) else None
        if not isinstance(node, ast.Assign) or not isinstance(value, ast.BinOp):
            continue
        number = value.right
        own = [dotted(target) for target in node.targets] == [name] == [dotted(value.left)]
        plus = isinstance(value.op, ast.Add)
        if own and plus and isinstance(number, ast.Constant) and number_in(number):
            found.append((value, number))
    return found


def joined(module: Module, name: str) -> list[ast.expr]:
    """Return the uses of a name that `+` joins to a text, without str()."""
    found: list[ast.expr] = []
    for node in module.nodes:
        if not isinstance(node, ast.BinOp) or not isinstance(node.op, ast.Add):
            continue
        for side, other in ((node.left, node.right), (node.right, node.left)):
            if dotted(side) == name and _is_text(other):
                found.append(side)
    return found


def _is_text(value: ast.expr) -> bool:
    while isinstance(value, ast.BinOp):
        if _is_text(value.right):
            return True
        value = value.left
    return isinstance(value, ast.JoinedStr) or (
        isinstance(value, ast.Constant) and isinstance(value.value, str)
    )


def number(case: Case) -> Files | None:
    """Let the counter be a number: where it starts, grows, and is joined to a text."""
    node = case.node
    name = str(case.finding.params.get("name", ""))
    starts = starts_of(node, str) if node is not None else {}
    start = starts.get(name)
    if node is None or start is None or not number_in(start):
        return None
    module = node.module_of(start)
    text = module.text
    sums = counted_up(module, name)
    inside = [total.left for total, _ in sums]
    numbers = (start, *appended(module, name), *(number for _, number in sums))
    uses = [use for use in joined(module, name) if use not in inside]
    return case.changed(
        module,
        *(text.swap(value, number_in(value)) for value in numbers),
        *(text.swap(use, f"str({text.code(use)})") for use in uses),
    )


def _uses(module: Module, name: str) -> list[ast.Name]:
    return [n for n in module.nodes if isinstance(n, ast.Name) and n.id == name]


def other_name(case: Case) -> Files | None:
    """Give the variable of a function the name with `_` at its end; calls keep the old name."""
    node, module = case.node, case.module
    name = str(case.finding.params.get("name", ""))
    new = f"{name}_"
    if node is None or module is None or not name or new in module.names:
        return None
    uses = _uses(module, name)
    called = [use for use in uses if getattr(module.parents.get(use), "func", None) is use]
    own = [use for use in uses if use not in called]
    around = {node.function_around(use) for use in own}
    if len(around) != 1 or None in around or not any(isinstance(n.ctx, ast.Store) for n in own):
        return None
    splices = splices_of(module, own, new)
    return case.changed(module, *splices) if splices else None
