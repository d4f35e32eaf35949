"""Kinds of check for the log of a scenario's nodes."""

from __future__ import annotations

import re
from itertools import pairwise
from typing import TYPE_CHECKING, Literal

from pydantic import Field, field_validator

from grader.base.i18n.message import say, say_plural
from grader.base.nearest import nearest, with_difference
from grader.base.yaml_model import broken
from grader.course.values import Form
from grader.verdict.checks.declare import Parameters, kind
from grader.verdict.checks.faults import line_of
from grader.verdict.outcome import Blocked, Failed, Passed

if TYPE_CHECKING:
    from grader.run.observer import Event
    from grader.verdict.use import Use

MOST_LINES = 200  # of a log, among which a similar one is looked for
CLOSE = 0.6
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


class Counts(Parameters):
    """A line that counts: `text` has {n} once; the numbers go up by `step`.

    With a `period` (s), one line comes at each of its instants in the window.
    """

    text: str
    start: int = 0
    step: int = 1
    at_least: int = Field(default=2, ge=2)
    period: float | None = Field(default=None, gt=0)

    @field_validator("text")
    @classmethod
    def _has_number(cls, text: str) -> str:
        if text.count("{n}") != 1:
            raise broken("text must contain {n} exactly once")
        return text


@kind("log.matches", Lines, after=["topic.values", "world.stays"])
def matches(use: Use[Lines]) -> Passed:
    """The node logs {text}"""
    given = use.given
    use.require_window()
    found = _lines(use, given.text, given.level)
    if len(found) < given.at_least:
        use.blocked_by("topic.subscribes", "world.stays")
        _must_drive(use)
        close = _nearest(use, given.text) if not found else None
        if close is not None:
            raise Failed(
                "log.wrong_text",
                expected=_wanted(given),
                actual=with_difference(close.text, close.text, _literal(given.text)),
                where=line_of(use.evidence, close.record),
                words={"wanted": _literal(given.text)},
            )
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


@kind("log.counts", Counts, after=["log.matches"])
def counts(use: Use[Counts]) -> Passed:
    """The node counts in its log: {text}"""
    given = use.given
    use.require_window()
    before, after = map(re.escape, given.text.split("{n}"))
    form = Form(matches=f"^{before}-?[0-9]+{after}$")
    found = _lines(use, form, "")
    wanted = [given.text.replace("{n}", str(given.start + k * given.step)) for k in range(3)]
    expected = ", ".join([*wanted, "…"])
    where = use.call("info", "warning", "warn", "error")
    if len(found) < given.at_least:
        raise Failed("log.missing", expected=expected, actual=_count(len(found)), where=where)
    for k, event in enumerate(found):
        due = given.text.replace("{n}", str(given.start + k * given.step))
        if event.text != due:
            raise Failed(
                "log.wrong_count",
                expected=due,
                actual=with_difference(event.text, event.text, due),
                where=line_of(use.evidence, event.record),
            )
    gaps = [round(b.virtual - a.virtual, 6) for a, b in pairwise(found)]
    late = [gap for gap in gaps if given.period and abs(gap - given.period) > 1e-6]
    if late:
        raise Failed(
            "log.wrong_period",
            expected=say("one line every {period} s", period=f"{given.period:g}"),
            actual=say("{gap} s between two lines", gap=f"{late[0]:g}"),
            where=use.call("create_timer"),
            words={"wanted": f"{given.period:g}"},
        )
    return Passed(actual=_count(len(found)))


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


def _must_drive(use: Use[Parameters]) -> None:
    """Raise Blocked if the world's check was skipped: what is logged depends on the way."""
    for other in use.evidence.assignment.checks:
        result = use.evidence.results.get(other.id)
        if other.kind == "world.stays" and result is not None and result.status == "skipped":
            raise Blocked(by=result.blocked_by or other.id)


def _literal(form: Form) -> str:
    """Return the text that a form asks for, as far as it is plain; "" if it is not."""
    if form.matches is not None:
        text = form.matches.removeprefix("^").removesuffix("$")
        return text if re.escape(text).replace("\\ ", " ") == text else ""
    return str(form.equal or form.contains or "")


def _nearest(use: Use[Parameters], form: Form) -> Event | None:
    """Return a line of the log that is nearly the wanted one."""
    wanted = _literal(form)
    lines = {event.text: event for event in _lines(use, Form(contains=""), "")}
    close = nearest(wanted, list(lines)[:MOST_LINES], cutoff=CLOSE) if wanted else ""
    return lines.get(close or "")


def _wanted(given: Lines) -> str:
    bound = f"{given.at_least}" if given.at_most is None else f"{given.at_least} … {given.at_most}"
    return f"{given.text} ({bound}×)"


def _count(count: int) -> str:
    return say_plural("{count} such line", "{count} such lines", count)
