"""Small changes of a condition: of what counts as no value, and of sums that are not exact."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.package.source.change import Change, of_piece
from grader.package.source.counter import targets_of
from grader.package.source.module import Module
from grader.package.source.names import dotted
from grader.package.source.node import NodeSource
from grader.package.source.small_values import Found, Goal, Sort, between

DIGITS = 6
"""The digits after the point to which a sum of floats is rounded."""
BITWISE = (
    ("bits", ast.BitAnd, "and"),
    ("bits", ast.BitOr, "or"),
    ("power", ast.BitXor, "**"),
)
"""The operators that work on bits, and what beginners mean by them, by the sort of the change."""
REACHED = (ast.Eq, ast.GtE, ast.Gt, ast.NotEq, ast.LtE, ast.Lt)


def _falsy(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield conditions that ask for None, where any empty value and 0 count as no value."""
    del source, goal
    text, flags = module.text, _flags(module)
    for node in module.nodes:
        if isinstance(node, ast.BoolOp) and isinstance(node.op, ast.Or) and len(node.values) == 2:
            first, other = (text.code(value) for value in node.values)
            new = f"{other} if {first} is None else {first}"
            whole = isinstance(module.parents.get(node), ast.Assign | ast.Return | ast.keyword)
            yield 1, of_piece(module, "falsy", node, new if whole else f"({new})", first)
        elif isinstance(node, ast.If | ast.IfExp | ast.While):
            test = node.test
            asked = test.operand if isinstance(test, ast.UnaryOp) else test
            if dotted(asked) and not isinstance(asked, ast.Call) and dotted(asked) not in flags:
                named = text.code(asked)
                new = f"{named} is None" if asked is not test else f"{named} is not None"
                yield 2, of_piece(module, "falsy", test, new, named)
                other = f"{named} is not None" if asked is not test else f"{named} is None"
                yield 3, of_piece(module, "value", test, other)


def _flags(module: Module) -> set[str]:
    """Return the names that are set to True or False: the condition of one asks for nothing else."""
    found = {
        name
        for n in module.nodes
        if isinstance(n, ast.Assign | ast.AnnAssign) and _is_bool(n.value)
        for name in targets_of(n)
    }
    for n in module.nodes:
        if isinstance(n, ast.arguments):
            named = [*n.posonlyargs, *n.args]
            pairs = [*zip(named[::-1], n.defaults[::-1]), *zip(n.kwonlyargs, n.kw_defaults)]
            found |= {a.arg for a, value in pairs if _is_bool(value)}
    return found


def _is_bool(value: ast.expr | None) -> bool:
    return isinstance(value, ast.Constant) and isinstance(value.value, bool)


def _inexact(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield comparisons and integers of a float that is rounded first."""
    del source, goal
    text = module.text
    for node in module.nodes:
        if isinstance(node, ast.Compare) and isinstance(node.ops[0], REACHED):
            left = node.left
            if isinstance(left, ast.BinOp) and isinstance(left.op, ast.Mod):
                left = left.left
            yield 1, _rounded(module, left)
        elif isinstance(node, ast.Call) and dotted(node.func) == "int" and len(node.args) == 1:
            given = text.code(node.args[0])
            yield 2, of_piece(module, "inexact", node, f"round({given})", given)
        elif isinstance(node, ast.AugAssign) and isinstance(node.op, ast.Add):
            name = text.code(node.target)
            new = f"{name} = round({name} + {text.code(node.value)}, {DIGITS})"
            yield 1, of_piece(module, "inexact", node, new, name)
        elif isinstance(node, ast.BinOp) and isinstance(node.op, ast.FloorDiv):
            yield 2, _rounded(module, node.left)


def _rounded(module: Module, node: ast.expr) -> Change:
    code = module.text.code(node)
    return of_piece(module, "inexact", node, f"round({code}, {DIGITS})", code)


def _whole(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield floats without a fraction as integers, and integers as floats."""
    del source, goal
    for node in module.nodes:
        if not isinstance(node, ast.Constant):
            continue
        value = node.value
        if isinstance(value, float) and value.is_integer():
            yield 2, of_piece(module, "value", node, str(int(value)))
        elif isinstance(value, int) and not isinstance(value, bool):
            yield 4, of_piece(module, "value", node, str(float(value)))


def _bits(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield the operators of conditions, and powers, in the place of those that work on bits."""
    del source, goal
    text = module.text
    for node in module.nodes:
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Invert):
            new = f"not {text.code(node.operand)}"
            around = module.parents.get(node)
            whole = isinstance(around, ast.Assign | ast.Return | ast.If | ast.While | ast.BoolOp)
            yield 1, of_piece(module, "bits", node, new if whole else f"({new})")
        elif isinstance(node, ast.BinOp):
            for sort, kind, sign in BITWISE:
                if isinstance(node.op, kind):
                    yield 1, replace(between(module, node, node.left, node.right, sign), sort=sort)


SORTS: tuple[Sort, ...] = (_falsy, _inexact, _whole, _bits)
