"""Kinds of check for the log of a scenario's nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from pydantic import Field

from grader.base.i18n.message import say_plural
from grader.course.values import Form
from grader.verdict.checks.declare import Parameters, kind
from grader.verdict.checks.faults import line_of
from grader.verdict.outcome import Failed, Passed

if TYPE_CHECKING:
    from grader.run.observer import Event
    from grader.verdict.use import Use

LEVELS = {"debug": 10, "info": 20, "warn": 30, "error": 40, "fatal": 50}
Level = Literal["", "debug", "info", "warn", "error", "fatal"]


class Lines(Parameters):
    """Lines of the node's log: their text, and how many there must be at least and at most."""

    text: Form
    level: Level = ""
    at_least: int = Field(default=1, ge=0)
    at_most: int | None = Field(default=None, ge=0)


class Never(Parameters):
    """Lines that must not be in the log."""

    text: Form
    level: Level = ""


@kind("log.matches", Lines, after=["topic.values"])
def matches(use: Use[Lines]) -> Passed:
    """The node logs {text}"""
    given = use.given
    use.require_window()
    found = _lines(use, given.text, given.level)
    if len(found) < given.at_least:
        raise Failed(
            "log.missing",
            expected=_wanted(given),
            actual=_count(len(found)),
            where=use.call("info", "warning", "warn", "error"),
        )
    if given.at_most is not None and len(found) > given.at_most:
        raise Failed(
            "log.too_often",
            expected=_wanted(given),
            actual=_count(len(found)),
            where=line_of(use.evidence, found[0].record),
        )
    return Passed(actual=_count(len(found)))


@kind("log.never", Never, after=["log.matches"])
def never(use: Use[Never]) -> Passed:
    """The node never logs {text}"""
    found = _lines(use, use.given.text, use.given.level)
    if found:
        raise Failed(
            "log.forbidden",
            expected=_count(0),
            actual=found[0].text[:200],
            where=line_of(use.evidence, found[0].record),
        )
    use.require_window()
    return Passed(actual=_count(0))


def _lines(use: Use[Parameters], text: Form, level: Level) -> list[Event]:
    logger = use.node.strip("/").replace("/", ".")
    return [
        event
        for event in use.in_window(use.run.watch.events, lambda event: event.virtual)
        if event.record is not None
        and event.record.name == logger
        and (not level or event.record.level == LEVELS[level])
        and text.fits(event.text)
    ]


def _wanted(given: Lines) -> str:
    bound = f"{given.at_least}" if given.at_most is None else f"{given.at_least} … {given.at_most}"
    return f"{given.text} ({bound}×)"


def _count(count: int) -> str:
    return say_plural("{count} such line", "{count} such lines", count)
