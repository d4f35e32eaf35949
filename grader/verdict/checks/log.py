"""Kinds of check for the log of a scenario's nodes."""

from __future__ import annotations

import re
from itertools import pairwise
from typing import TYPE_CHECKING

from pydantic import Field, model_validator

from grader.base.i18n.message import Message as Text
from grader.base.i18n.message import joined, say
from grader.base.i18n.times import times
from grader.base.nearest import compared, nearest
from grader.base.shown import shown
from grader.base.yaml_model import broken
from grader.course.values import Form
from grader.verdict.checks.declare import ANSWERS, kind
from grader.verdict.checks.faults import line_of
from grader.verdict.checks.lines import (
    CALLS,
    Level,
    level_of,
    lines,
    other_texts,
    records,
    such_lines,
)
from grader.verdict.checks.parameters import EDGE, Parameters
from grader.verdict.outcome import Blocked, Failed, Passed

if TYPE_CHECKING:
    from grader.run.observer import Event
    from grader.verdict.use import Use

MOST_LINES = 200  # of a log, among which a similar one is looked for
MOST_TOLD = 3  # lines that came instead
CLOSE = 0.6


class Lines(Parameters):
    """Lines of the node's log: their text, and how many there must be at least and at most.

    The text is what the logger got, without `[INFO] [time] [node]:` before it. Two of them must be `apart` seconds of ROS time or more.
    """

    text: Form
    level: Level = ""
    at_least: int = Field(default=1, ge=0)
    at_most: int | None = Field(default=None, ge=0)
    apart: float | None = Field(default=None, gt=0)

    @model_validator(mode="after")
    def _can_be(self) -> Lines:
        if self.at_most is not None and self.at_least > self.at_most:
            raise broken(f"at_least is {self.at_least}, above at_most, which is {self.at_most}")
        return self


class Never(Parameters):
    """Lines that must not be in the log."""

    text: Form
    level: Level = ""


@kind("log.matches", Lines, after=["topic.values", "topic.reacts", "world.stays", *ANSWERS])
def matches(use: Use[Lines]) -> Passed:
    """The node logs {text}"""
    given = use.given
    use.require_window()
    found = records(use, given.text, given.level)
    if len(found) < given.at_least:
        use.blocked_by("topic.subscribes", "world.stays")
        _must_drive(use)
        raise _too_few(use, found)
    for before, after in pairwise(found):
        gap = after.virtual - before.virtual
        if given.apart is not None and gap < given.apart - EDGE:
            raise Failed(
                "log.too_often",
                expected=say("at least {gap} s between two lines", gap=f"{given.apart:g}"),
                actual=say(
                    "{gap} s between two lines, at {first} s and {last} s",
                    gap=f"{gap:g}",
                    first=f"{before.virtual:g}",
                    last=f"{after.virtual:g}",
                ),
                where=line_of(use.evidence, after.record),
            )
    if given.at_most is not None and len(found) > given.at_most:
        raise Failed(
            "log.too_often",
            expected=_wanted(use),
            actual=joined(such_lines(len(found)), _with_instants(found), by=": "),
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
            actual=_with_instants(found[:1]),
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


def _too_few(use: Use[Lines], found: list[Event]) -> Failed:
    """Return the failure of lines that are missing: what came at that time instead."""
    given, literal = use.given, _literal(use.given.text)
    same = records(use, given.text) if given.level and not found else []
    if same and same[0].record is not None:
        wanted, level = given.level.upper(), level_of(same[0].record)
        return Failed(
            "log.wrong_level",
            expected=joined(_wanted(use), say("level {level}", level=wanted), by=", "),
            actual=joined(_with_instants(same), say("level {level}", level=level), by=", "),
            where=line_of(use.evidence, same[0].record),
            words={"level": given.level},
        )
    printed = [event for event in lines(use, given.text) if event.source == "print"]
    if printed and not found:
        raise Failed(
            "run.print_not_logger",
            expected=_wanted(use),
            actual=_with_instants(printed),
            where=line_of(use.evidence, printed[0].record),
        )
    others = [] if found else records(use, Form(contains=""))
    close = _nearest(use, others)
    if close is not None:
        return Failed(
            "log.wrong_text",
            expected=_wanted(use),
            actual=joined(_with_instants([close]), compared(close.text, literal), by="\n"),
            where=line_of(use.evidence, close.record),
            words={"wanted": literal},
        )
    actual = such_lines(len(found))
    if found or others:
        came = _with_instants(found or others)
        actual = joined(actual, came if found else say("it logged {lines}", lines=came), by=": ")
    return Failed("log.missing", expected=_wanted(use), actual=actual, where=use.call(*CALLS))


def _nearest(use: Use[Lines], others: list[Event]) -> Event | None:
    """Return a line that is nearly the wanted one, and that no other check asks for."""
    wanted = _literal(use.given.text)
    asked = other_texts(use)
    there = {
        event.text: event for event in others if not any(form.fits(event.text) for form in asked)
    }
    close = nearest(wanted, list(there)[:MOST_LINES], cutoff=CLOSE) if wanted else ""
    return there.get(close or "")


def _wanted(use: Use[Lines]) -> Text:
    """Return what must be logged how often; where only a part of the run counts, also when."""
    given = use.given
    bound = joined(given.text.words, times(given.at_least, given.at_most), by=": ")
    if not use.use.after and use.use.during is None:
        return bound
    first, last = use.window
    when = say("from {first} s to {last} s", first=f"{first:g}", last=f"{last:g}")
    return joined(bound, when, by=", ")


def _with_instants(events: list[Event]) -> Text:
    """Return the first of some lines, each with its instant."""
    told = [
        say("'{text}' at {at} s", text=shown(event.text), at=f"{event.virtual:g}")
        for event in events[:MOST_TOLD]
    ]
    return joined(*told, "…" if len(events) > MOST_TOLD else "", by=", ")
