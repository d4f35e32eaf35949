"""A callback that measures the time itself, and logs only if enough of it has passed."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.package.source.counter import targets_of
from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of
from grader.package.source.real_time import CLOCKS

SETS = ast.Assign | ast.AnnAssign


@dataclass(frozen=True)
class Measured:
    """The `if` that compares times, and the statements that are needed only for it.

    `returns` says that it ends the callback; else the lines that log are below it, indented.
    """

    block: ast.If
    needed: list[ast.stmt]
    returns: bool


def measured(source: NodeSource) -> Measured | None:
    """Return where the callback compares the time with one that it keeps from call to call."""
    callback = source.callback
    if callback is None:
        return None
    now = _times(source, callback)
    for block in callback.body:
        if not isinstance(block, ast.If) or block.orelse or not isinstance(block.test, ast.Compare):
            continue
        kept = _kept(source, callback, block.test, now)
        if kept is None or not _reads(source, block.test, now):
            continue
        logs, inside = source.logs(callback), source.logs(block)
        returns = len(block.body) == 1 and isinstance(block.body[0], ast.Return)
        after = returns and all(log.lineno > block.lineno for log in logs)
        if logs and (after or len(inside) == len(logs)):
            return Measured(block, _needed(source, callback, block, kept, now), returns)
    return None


def _times(source: NodeSource, callback: Function) -> set[str]:
    """Return the variables of the callback that get the time of a clock."""
    return {
        name
        for n in ast.walk(callback)
        if isinstance(n, SETS) and n.value is not None and _reads(source, n.value, set())
        for name in targets_of(n)
        if "." not in name
    }


def _reads(source: NodeSource, part: ast.expr, now: set[str]) -> bool:
    """Whether an expression has the time of a clock in it."""
    own = {**source.module.functions, **source.methods}
    for call, name in calls_in(part):
        if last_part(name) in CLOCKS or last_part(name) == "now":
            return True
        function = own.get(last_part(name))
        inner = calls_in(function) if function is not None and not call.args else ()
        if any(last_part(each) in CLOCKS or last_part(each) == "now" for _, each in inner):
            return True
    return any(isinstance(n, ast.Name) and n.id in now for n in ast.walk(part))


def _kept(source: NodeSource, callback: Function, test: ast.Compare, now: set[str]) -> str | None:
    """Return the attribute of a comparison that the callback sets to a time."""
    logged = {dotted(n) for log in source.logs(callback) for n in ast.walk(log)}
    names = {dotted(n) for n in ast.walk(test) if isinstance(n, ast.Attribute)} - logged
    for statement in ast.walk(callback):
        value = getattr(statement, "value", None)
        if not isinstance(statement, SETS | ast.AugAssign) or not isinstance(value, ast.expr):
            continue
        for name in targets_of(statement):
            adds = isinstance(statement, ast.AugAssign)
            if name in names and name.startswith("self.") and (adds or _reads(source, value, now)):
                return name
    return None


def _needed(
    source: NodeSource, callback: Function, block: ast.If, kept: str, now: set[str]
) -> list[ast.stmt]:
    """Return the statements that set the kept time, and the variables that nothing else uses."""
    sets = [
        n
        for n in source.own_nodes
        if isinstance(n, SETS | ast.AugAssign) and list(targets_of(n)) == [kept]
    ]
    inside = {n for part in (block.test, *sets) for n in ast.walk(part)}
    uses = [n for n in ast.walk(callback) if isinstance(n, ast.Name) and n not in inside]
    read = {n.id for n in uses if isinstance(n.ctx, ast.Load)}
    sets += [
        n
        for n in ast.walk(callback)
        if isinstance(n, SETS)
        and set(targets_of(n)) <= now - read
        and len(list(targets_of(n))) == 1
    ]
    found = [n for n in sets if len(block_of(source.module_of(n), n)) > 1]
    return sorted(found, key=lambda n: n.lineno)
