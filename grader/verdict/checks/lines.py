"""Shared by the kinds of check for the log: the lines of a run that a use of them is about."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Literal

from grader.base.i18n.message import say_plural
from grader.course.values import Form
from grader.run.probe_link import LEVELS
from grader.verdict.checks.parameters import Parameters

if TYPE_CHECKING:
    from grader.run.observer import Event
    from grader.run.probe_link import LogRecord
    from grader.verdict.use import Use

Level = Literal["", "debug", "info", "warn", "error", "fatal"]
CALLS = ("info", "warning", "warn", "error")  # of a logger


def numbered(text: str) -> Form:
    """Return the form of a text in which {n} stands for any whole number."""
    parts = map(re.escape, text.split("{n}"))
    return Form(matches=f"^{'-?[0-9]+'.join(parts)}$")


def lines(use: Use[Parameters], text: Form) -> list[Event]:
    """Return the lines of a form in a scenario's window, however they were written."""
    events = use.in_window(use.run.watch.events, lambda event: event.virtual)
    return [event for event in events if text.fits(event.text)]


def records(use: Use[Parameters], text: Form, level: Level = "") -> list[Event]:
    """Return those of them that the node's logger wrote, with any level if it is ""."""
    name = logger_of(use)
    return [
        event
        for event in lines(use, text)
        if event.record is not None
        and event.record.name == name
        and (not level or event.record.level == LEVELS[level])
    ]


def other_texts(use: Use[Parameters]) -> list[Form]:
    """Return the forms of the lines that other checks of the log ask for."""
    found = []
    for other in use.evidence.assignment.checks:
        text = other.with_.get("text")
        if other.id == use.use.id or text is None or not other.kind.startswith("log."):
            continue
        is_form = other.kind in ("log.matches", "log.never")
        found.append(Form.model_validate(text) if is_form else numbered(str(text)))
    return found


def level_of(record: LogRecord) -> str:
    """Return the level of a record as ROS prints it."""
    names = {number: name.upper() for name, number in LEVELS.items()}
    return names.get(record.level, str(record.level))


def logger_of(use: Use[Parameters]) -> str:
    """Return the name of the logger of the node that a scenario's use judges."""
    return use.node.strip("/").replace("/", ".")


def such_lines(count: int) -> str:
    """Return a number of lines in words."""
    return say_plural("{count} such line", "{count} such lines", count)
