"""A node that is created in the call of rclpy.spin, beside one that is never spun."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.package.source.counter import targets_of
from grader.package.source.module import Function
from grader.package.source.names import SPINS, calls_in, dotted, last_part


@dataclass(frozen=True)
class SecondNode:
    """The variable of the first node, the line that creates it, and the call of spin."""

    name: str
    line: int
    spin: ast.Call


def second_node(tree: ast.AST) -> SecondNode | None:
    """Return the first `spin(C())` of a function that assigns another C() to a variable.

    None if anything is called with that variable: it may be spun in another way.
    """
    for function in (n for n in ast.walk(tree) if isinstance(n, Function)):
        calls = list(calls_in(function))
        passed = {n.id for call, _ in calls for n in _given(call) if isinstance(n, ast.Name)}
        for call, name in calls:
            made = call.args[0] if last_part(name) in SPINS and call.args else None
            first = _first_of(function, made) if isinstance(made, ast.Call) else None
            if first is None:
                continue
            variable = next(targets_of(first), "")
            if variable and "." not in variable and variable not in passed:
                return SecondNode(variable, first.lineno, call)
    return None


def _first_of(function: Function, made: ast.Call) -> ast.Assign | None:
    """Return the only assignment of a function that makes an object in the same way."""
    code = ast.unparse(made)
    found = [
        n for n in ast.walk(function) if isinstance(n, ast.Assign) and ast.unparse(n.value) == code
    ]
    plain = dotted(made.func)[:1].isupper() and not made.args and not made.keywords
    alone = len(found) == 1 and len(found[0].targets) == 1
    return found[0] if plain and alone and found[0].lineno < made.lineno else None


def _given(call: ast.Call) -> list[ast.AST]:
    given = (*call.args, *(keyword.value for keyword in call.keywords))
    return [part for value in given for part in ast.walk(value)]
