"""The counter that the callback logs, and what changes it."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.mistakes.recognised import Suspect
from grader.package.source.counter import logged_counter, parts_of_callback, targets_of
from grader.package.source.names import called_name, dotted


@dataclass(frozen=True)
class Counter:
    """The counter of a callback: its name, and the statements that change it."""

    name: str
    added: list[ast.AugAssign]
    set: list[ast.Assign | ast.AnnAssign]
    logged: ast.Call  # the first log call


def counter_in(suspect: Suspect) -> Counter | None:
    """Return the counter that the callback logs; None if it logs none."""
    callback, logged = suspect.source.callback, logged_counter(suspect.source)
    if callback is None or logged is None:
        return None
    call, name = logged
    parts = parts_of_callback(suspect.source)
    found = [n for part in parts for n in ast.walk(part) if name in targets_of(n)]
    added = [n for n in found if isinstance(n, ast.AugAssign)]
    return Counter(
        name,
        sorted(added, key=lambda n: n.lineno),
        [n for n in found if isinstance(n, ast.Assign | ast.AnnAssign)],
        call,
    )


def text_added(statement: ast.Assign) -> str:
    """Return what is added in `x = x + '1'`; "" if the statement has another form."""
    value = statement.value
    if not isinstance(value, ast.BinOp) or dotted(value.left) not in targets_of(statement):
        return ""
    step = value.right.value if isinstance(value.right, ast.Constant) else None
    return step if isinstance(step, str) else ""


def has_text(value: ast.expr) -> bool:
    """Whether one of the parts of a sum is a text for certain."""
    if isinstance(value, ast.BinOp) and isinstance(value.op, ast.Add):
        return has_text(value.left) or has_text(value.right)
    if isinstance(value, ast.BinOp) and isinstance(value.op, ast.Mod):
        return has_text(value.left)
    made = isinstance(value, ast.Call) and called_name(value) in ("str", "format", "join")
    plain = isinstance(value, ast.Constant) and isinstance(value.value, str)
    return made or plain or isinstance(value, ast.JoinedStr)
