"""Mistakes with a callback that a base class has too: it is replaced, or called too early."""

from __future__ import annotations

import ast
from dataclasses import dataclass, replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import LOG_LINE, NODE, STEP_LINE, example
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.counter import adds_to, names_given, targets_of
from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import NodeSource

BASE = (
    "class CountingBase(Node):\n\n    def timer_callback(self):\n        self.counter_ += 1\n\n\n"
    "class MyFirstNode(CountingBase)"
)


@dataclass(frozen=True)
class Replaced:
    """A method that logs in place of one of its base class, which adds to what is logged."""

    method: Function
    log: ast.stmt
    base: ast.ClassDef
    step: ast.stmt

    @property
    def words(self) -> dict[str, str]:
        """The values of the placeholders."""
        below = self.log.end_lineno or self.log.lineno
        return {"type": self.base.name, "line": str(self.step.lineno), "below": str(below)}


def _found(source: NodeSource) -> Replaced | None:
    """Return the callback of a timer that replaces the one of its base class, which counts."""
    by_name = {own.name: own for own in source.family}
    timers = {timer.method for timer in source.timers}
    for own in source.family:
        bases = [by_name[n] for n in map(last_part, map(dotted, own.bases)) if n in by_name]
        for method in (s for s in own.body if isinstance(s, Function) and s.name in timers):
            logs = [s for s in method.body if isinstance(s, ast.Expr) and source.logs(s)]
            if len(logs) != 1 or len(source.logs(method)) != 1:
                continue
            shown = set(names_given(source.logs(method)[0]))
            for made in (s for s in method.body if isinstance(s, ast.Assign)):
                if shown.intersection(targets_of(made)):
                    shown |= {dotted(n) for n in ast.walk(made.value)} - {"", "self"}
            for base in bases:
                steps = [s for s in _body_of(base, method.name) if _adds(s, shown)]
                if len(steps) == 1 and not any(_adds(n, shown) for n in ast.walk(method)):
                    return Replaced(method, logs[0], base, steps[0])
    return None


def _body_of(own: ast.ClassDef, name: str) -> list[ast.stmt]:
    """Return the lines of a method of a class, none if it does not have the method."""
    found = [s for s in own.body if isinstance(s, Function) and s.name == name]
    return found[0].body if len(found) == 1 else []


def _adds(node: ast.AST, names: set[str]) -> bool:
    return any(adds_to(node, name) for name in names)


def _calls_of_base(callback: Function) -> list[ast.Call]:
    """Return the calls of the methods that a callback replaces: `super().tick()`, `Base.tick(self)`."""
    own = f"self.{callback.name}"
    calls = calls_in(callback)
    return [c for c, name in calls if last_part(name) == callback.name and name != own]


def _replaced(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a callback that replaces the method of its base which counts."""
    found = _found(suspect.source)
    if found is None or _calls_of_base(found.method):
        return None
    mistake = suspect.finding("base_replaced", found.method, method=found.method.name)
    return replace(mistake, words={**mistake.words, **found.words})


def _too_early(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a call of the base's method, which counts, above the line that logs."""
    found, output = _found(suspect.source), suspect.output
    first = output.text.replace("{n}", str(output.start + output.step))
    if found is None or suspect.lines[:1] != (first,):
        return None
    calls = _calls_of_base(found.method)
    for statement in found.method.body:
        value = statement.value if isinstance(statement, ast.Expr) else None
        if len(calls) == 1 and value is calls[0] and statement.lineno < found.log.lineno:
            mistake = suspect.finding("base_first", statement, method=found.method.name)
            return replace(mistake, words={**mistake.words, **found.words})
    return None


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "base_replaced",
        "counter",
        msg("The method replaces the one of its base class, which counts"),
        msg(
            "A method of a class replaces the one with the same name of its base class. The timer calls "
            "this {method}, and {method} of {type} with line {line}, which counts, does not run."
        ),
        msg("Write super().{method}() below line {below}, which logs."),
        behind={"run.constant_counter": _replaced},
        examples=(
            example(
                "callback_of_base_replaced",
                Replace(NODE, "class MyFirstNode(Node)", BASE),
                Replace(NODE, LOG_LINE + STEP_LINE, LOG_LINE),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "base_first",
        "counter",
        msg("The counter is increased before the line is logged"),
        msg(
            "This line runs {method} of {type}, which adds to the counter in line {line}. The log line "
            "below it shows the next number already."
        ),
        msg("Move this line below line {below}, which logs."),
        behind={"run.wrong_start": _too_early},
        examples=(
            example(
                "callback_of_base_first",
                Replace(NODE, "class MyFirstNode(Node)", BASE),
                Replace(
                    NODE, LOG_LINE + STEP_LINE, f"        super().timer_callback()\n{LOG_LINE}"
                ),
                fails="run.output",
            ),
        ),
    ),
)
