"""Recognise the mistake behind a wrong count in the callback's source."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.mistakes.kind import RecognisedMistake
from grader.mistakes.symptoms import Suspect
from grader.package.source.counter import logged_counter, starts_of, targets_of


@dataclass(frozen=True)
class Counter:
    """The counter of a callback: its name, and the statements that change it."""

    name: str
    added: list[ast.AugAssign]
    set: list[ast.Assign]
    logged: ast.Call  # the first log call


def _counter(suspect: Suspect) -> Counter | None:
    callback, logged = suspect.source.callback, logged_counter(suspect.source)
    if callback is None or logged is None:
        return None
    call, name = logged
    found = [n for n in ast.walk(callback) if name in targets_of(n)]
    added = [n for n in found if isinstance(n, ast.AugAssign)]
    return Counter(
        name,
        sorted(added, key=lambda n: n.lineno),
        [n for n in found if isinstance(n, ast.Assign)],
        call,
    )


def _plus_reversed(suspect: Suspect, counter: Counter) -> RecognisedMistake | None:
    for node in counter.set:
        if isinstance(node.value, ast.UnaryOp) and isinstance(node.value.op, ast.UAdd):
            return suspect.finding("plus_reversed", node, name=counter.name)
    return None


def constant(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the reason why the number stays the same."""
    counter = _counter(suspect)
    if counter is None:
        return None
    found = _plus_reversed(suspect, counter)
    if found is not None:
        return found
    for node in counter.set:
        if isinstance(node.value, ast.Constant):
            value = str(node.value.value)[:40]
            return suspect.finding("counter_reset", node, name=counter.name, value=value)
    if counter.added or counter.set:
        return None
    return suspect.finding("counter_not_increased", counter.logged, name=counter.name)


def wrong_step(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the reason why the count increases by a different number."""
    counter = _counter(suspect)
    if counter is None:
        return None
    found = _plus_reversed(suspect, counter)
    if found is not None:
        return found
    if len(counter.added) > 1:
        second = counter.added[1]
        return suspect.finding("adds_twice", second, name=counter.name, step=suspect.output.step)
    for node in counter.added:
        added = isinstance(node.op, ast.Add) and isinstance(node.value, ast.Constant)
        if not added or getattr(node.value, "value", 1) != suspect.output.step:
            return suspect.finding("other_step", node, name=counter.name, step=suspect.output.step)
    return None


def wrong_start(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the reason why the first number is different."""
    counter = _counter(suspect)
    if counter is None:
        return None
    if counter.added and counter.added[0].lineno < counter.logged.lineno:
        return suspect.finding("adds_before_log", counter.added[0], name=counter.name)
    init = suspect.source.methods.get("__init__")
    for node in ast.walk(init) if init else ():
        if isinstance(node, ast.Assign) and counter.name in targets_of(node):
            return _starts_elsewhere(suspect, node, counter)
    start = starts_of(suspect.source).get(counter.name)
    return _starts_elsewhere(suspect, start, counter) if start is not None else None


def _starts_elsewhere(
    suspect: Suspect, at: ast.stmt | ast.expr, counter: Counter
) -> RecognisedMistake:
    start = suspect.output.start
    return suspect.finding("starts_elsewhere", at, name=counter.name, start=start)
