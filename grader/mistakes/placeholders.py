"""The values of placeholders in the catalogue, from the assignment and the student's source.

A text never names a part of one exercise: it has a placeholder instead.
"""

from __future__ import annotations

from collections.abc import Mapping

from grader.base.i18n.message import Value
from grader.course.assignment import Assignment, Output
from grader.package.source.counter import logged_counter, starts_of
from grader.package.source.node import NodeSource

CALLBACK = "callback"  # default names, if the student's source has none
NODE = "node"
COUNTER = "self.counter"


def placeholder_values(
    assignment: Assignment, source: NodeSource | None = None
) -> dict[str, Value]:
    """Return the values that the assignment and the source give to placeholders.

    `period` is in seconds (… if the assignment names none), `callback` is a bare name, `counter` begins with `self.`, `node` is the node's variable; `sum` and
    `f_string` are two ways to write the text of a line in Python.
    """
    output = assignment.output
    counter = _counter_of(source)
    return {
        "package": assignment.package,
        "executable": assignment.executable,
        "node_name": assignment.node_name,
        "function": assignment.function,
        "period": assignment.seconds,
        "start": output.start,
        "step": output.step,
        "line": output.line(0),
        "callback": _callback_of(source),
        "counter": counter,
        "node": _variable_of(source),
        "sum": as_sum(output, counter),
        "f_string": as_f_string(output, counter),
    }


def _variable_of(source: NodeSource | None) -> str:
    """Return the variable that has the node, if there is exactly one."""
    variables = source.node_variables if source is not None else set()
    return min(variables) if len(variables) == 1 else NODE


def _example() -> Mapping[str, Value]:
    text = Output(text="Count: {n}")
    return {
        "function": "main",
        "counter": COUNTER,
        "node": NODE,
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
"""Values of some placeholders if there is no assignment; the others show their names."""


def _callback_of(source: NodeSource | None) -> str:
    """Return the name of the callback, or the name that a timer refers to."""
    if source is None:
        return CALLBACK
    named = [timer.method for timer in source.timers if timer.method]
    return source.callback.name if source.callback else (named or [CALLBACK])[0]


def _counter_of(source: NodeSource | None) -> str:
    logged = logged_counter(source) if source is not None else None
    starts = list(starts_of(source)) if source is not None and logged is None else []
    return logged[1] if logged else starts[0] if len(starts) == 1 else COUNTER
