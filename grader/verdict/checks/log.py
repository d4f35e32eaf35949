"""Kinds of check for the log of a scenario's nodes."""

from __future__ import annotations

import re
from itertools import pairwise
from typing import TYPE_CHECKING

from pydantic import Field

from grader.base.i18n.message import say
from grader.base.nearest import nearest, with_difference
from grader.course.values import Form
from grader.verdict.checks.declare import EDGE, Parameters, kind
from grader.verdict.checks.faults import line_of
from grader.verdict.checks.lines import CALLS, Level, records, such_lines
from grader.verdict.outcome import Blocked, Failed, Passed

if TYPE_CHECKING:
    from grader.run.observer import Event
    from grader.verdict.use import Use

MOST_LINES = 200  # of a log, among which a similar one is looked for
CLOSE = 0.6


class Lines(Parameters):
    """Lines of the node's log: their text, and how many there must be at least and at most.

    Two of them must be `apart` seconds of ROS time or more.
    """

    text: Form
    level: Level = ""
    at_least: int = Field(default=1, ge=0)
    at_most: int | None = Field(default=None, ge=0)
    apart: float | None = Field(default=None, gt=0)


class Never(Parameters):
    """Lines that must not be in the log."""

    text: Form
    level: Level = ""


@kind("log.matches", Lines, after=["topic.values", "world.stays"])
def matches(use: Use[Lines]) -> Passed:
    """The node logs {text}"""
    given = use.given
    use.require_window()
    found = records(use, given.text, given.level)
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
            actual=such_lines(len(found)),
            where=use.call(*CALLS),
        )
    for before, after in pairwise(found):
        gap = after.virtual - before.virtual
        if given.apart is not None and gap < given.apart - EDGE:
            raise Failed(
                "log.too_often",
                expected=say("at least {gap} s between two lines", gap=f"{given.apart:g}"),
                actual=say("{gap} s between two lines", gap=f"{gap:g}"),
                where=line_of(use.evidence, after.record),
            )
    if given.at_most is not None and len(found) > given.at_most:
        raise Failed(
            "log.too_often",
            expected=_wanted(given),
            actual=such_lines(len(found)),
            where=line_of(use.evidence, found[0].record),
        )
    return Passed(actual=such_lines(len(found)))


@kind("log.never", Never, after=["log.matches"])
def never(use: Use[Never]) -> Passed:
    """The node never logs {text}"""
    found = records(use, use.given.text, use.given.level)
    if found:
        raise Failed(
            "log.forbidden",
            expected=such_lines(0),
            actual=found[0].text[:200],
            where=line_of(use.evidence, found[0].record),
        )
    use.require_window()
    return Passed(actual=such_lines(0))


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
    there = {event.text: event for event in records(use, Form(contains=""))}
    close = nearest(wanted, list(there)[:MOST_LINES], cutoff=CLOSE) if wanted else ""
    return there.get(close or "")


def _wanted(given: Lines) -> str:
    bound = f"{given.at_least}" if given.at_most is None else f"{given.at_least} … {given.at_most}"
    return f"{given.text} ({bound}×)"
