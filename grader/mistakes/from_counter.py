"""Recognise the mistake behind a wrong count in the callback's source."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.mistakes.kind import RecognisedMistake
from grader.mistakes.placeholders import logged_counter
from grader.mistakes.symptoms import Suspect
from grader.package.source.node import dotted


@dataclass(frozen=True)
class Counter:
    """The counter of a callback: its name, and the statements that change it."""

    name: str
    added: list[ast.AugAssign]
    set: list[ast.Assign]
    logged: int  # the line of the first log call


def _counter(suspect: Suspect) -> Counter | None:
    callback = suspect.source.callback
    if callback is None:
        return None
    names = logged_counter(suspect.source, callback)
    if not names:
        return None
    lines, name = names
    added = [n for n in ast.walk(callback) if isinstance(n, ast.AugAssign)]
    plain = [n for n in ast.walk(callback) if isinstance(n, ast.Assign)]
    return Counter(
        name,
        sorted((n for n in added if dotted(n.target) == name), key=lambda n: n.lineno),
        [n for n in plain if any(dotted(target) == name for target in n.targets)],
        lines,
    )


def _plus_reversed(suspect: Suspect, counter: Counter) -> RecognisedMistake | None:
    for node in counter.set:
        if isinstance(node.value, ast.UnaryOp) and isinstance(node.value.op, ast.UAdd):
            return suspect.finding("plus_reversed", node.lineno, name=counter.name)
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
            return suspect.finding("counter_reset", node.lineno, name=counter.name, value=value)
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
        line = counter.added[1].lineno
        return suspect.finding("adds_twice", line, name=counter.name, step=suspect.output.step)
    for node in counter.added:
        added = isinstance(node.op, ast.Add) and isinstance(node.value, ast.Constant)
        if not added or getattr(node.value, "value", 1) != suspect.output.step:
            return suspect.finding(
                "other_step", node.lineno, name=counter.name, step=suspect.output.step
            )
    return None


def wrong_start(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the reason why the first number is different."""
    counter = _counter(suspect)
    if counter is None:
        return None
    if counter.added and counter.added[0].lineno < counter.logged:
        return suspect.finding("adds_before_log", counter.added[0].lineno, name=counter.name)
    init = suspect.source.methods.get("__init__")
    for node in ast.walk(init) if init else ():
        if isinstance(node, ast.Assign) and any(dotted(t) == counter.name for t in node.targets):
            return suspect.finding(
                "starts_elsewhere", node.lineno, name=counter.name, start=suspect.output.start
            )
    return None
