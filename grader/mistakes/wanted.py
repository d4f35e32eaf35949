"""What the texts of the catalogue take from the assignment, and from the student's own source.

A text never names a part of one exercise: it has a placeholder, and this module fills it.
"""

from __future__ import annotations

from collections.abc import Mapping

from grader.base.i18n.message import Value
from grader.course.assignment import Assignment, Output
from grader.package.source.counter import logged_counter
from grader.package.source.node import NodeSource

CALLBACK = "callback"  # names for what the student's source does not have yet
COUNTER = "self.counter"
CLASS = "MyNode"


def words_of(assignment: Assignment, source: NodeSource | None = None) -> dict[str, Value]:
    """Return a value for each placeholder that the assignment, or the source, can fill.

    `period` is in seconds, `callback` a bare name, `counter` with its `self.`; `sum` and
    `f_string` are two ways to write the text of a line in Python.
    """
    output = assignment.output
    counter = _counter_of(source)
    return {
        "package": assignment.package,
        "node_name": assignment.node_name,
        "function": assignment.function,
        "period": repr(output.period),
        "start": output.start,
        "step": output.step,
        "line": output.line(0),
        "callback": _callback_of(source),
        "counter": counter,
        "sum": as_sum(output, counter),
        "f_string": as_f_string(output, counter),
    }


def _example() -> Mapping[str, Value]:
    text = Output(text="Count: {n}")
    return {
        "function": "main",
        "counter": COUNTER,
        "sum": as_sum(text, COUNTER),
        "f_string": as_f_string(text, COUNTER),
    }


def as_sum(output: Output, counter: str) -> str:
    """Return the text of a line as texts joined by `+`, in Python."""
    head, tail = output.text.split("{n}")
    parts = [repr(head) if head else "", f"str({counter})", repr(tail) if tail else ""]
    return " + ".join(part for part in parts if part)


def as_f_string(output: Output, counter: str) -> str:
    """Return the text of a line as an f-string, in Python."""
    head, tail = (part.replace("{", "{{").replace("}", "}}") for part in output.text.split("{n}"))
    return "f" + repr(f"{head}{{{counter}}}{tail}")


EXAMPLE = _example()
"""Stands for some of the words where no assignment is at hand; the others show their names."""


def _callback_of(source: NodeSource | None) -> str:
    """Return the callback's name, as the source has it or as a timer of it asks for it."""
    if source is None:
        return CALLBACK
    named = [timer.method for timer in source.timers if timer.method]
    return source.callback.name if source.callback else (named or [CALLBACK])[0]


def _counter_of(source: NodeSource | None) -> str:
    logged = logged_counter(source) if source is not None else None
    return logged[1] if logged else COUNTER
