"""What each check is worth in the end: the report's points with the instructor's corrections.

A system that adds up its tests must come to the same total as the gradebook. `adjustments` are what lies
between the sum of the checks and the final points: a corrected total, points taken for lateness.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from grader.base.i18n.message import Message, joined, say
from grader.base.plain_text import one_line, points
from grader.batch.model import GradebookEntry, Override, Student
from grader.batch.words import duration
from grader.report.model import CheckResult, Report

DIGITS = 4  # of points, so that sums of decimals stay readable
OPEN = ("inconclusive", "error")


@dataclass(frozen=True)
class Mark:
    """A check and its points; None where they could be neither given nor taken."""

    check: CheckResult
    points: float | None
    override: Override | None = None

    @property
    def passed(self) -> bool:
        """Whether it counts as passed: it has all its points, or it passed and nobody corrected it."""
        if self.override is None:
            return self.check.status == "passed"
        return self.points is not None and self.points >= self.check.max_score

    @property
    def correction(self) -> str:
        """What the instructor changed and why, in one line; "" if nothing."""
        if self.override is None:
            return ""
        by, why = _named(self.override), one_line(self.override.because)
        given, before = points(self.override.points), points(self.check.score)
        if not by:
            return say(
                "Corrected: {given} instead of {before} points, because: {why}",
                given=given,
                before=before,
                why=why,
            )
        return say(
            "Corrected by {name}: {given} instead of {before} points, because: {why}",
            name=by,
            given=given,
            before=before,
            why=why,
        )


@dataclass(frozen=True)
class Adjustment:
    """Points that are added (or taken, below 0) after the checks, and why."""

    why: str
    points: float

    @property
    def told(self) -> Message:
        """The step in one line."""
        return joined(self.why, in_points(self.points), by=": ")


def in_points(value: float) -> Message:
    """Return a number of points with its noun."""
    return say("1 point") if value == 1 else say("{points} points", points=points(value))


def rounded(value: float) -> float:
    """Return points without the noise of binary fractions; never -0.0."""
    return round(value, DIGITS) + 0.0


def marks(entry: GradebookEntry) -> tuple[Mark, ...]:
    """Return the marks of an entry's report; () without one. Of two corrections the last counts."""
    if entry.report is None:
        return ()
    corrected = {override.check: override for override in entry.overrides}
    return tuple(_mark(check, corrected.get(check.id)) for check in entry.report.checks)


def adjustments(entry: GradebookEntry) -> tuple[Adjustment, ...]:
    """Return what leads from the sum of the marks to the final points; () if nothing is final."""
    if entry.final is None:
        return ()
    total = sum(mark.points or 0 for mark in marks(entry))
    score = total if entry.score is None else entry.score
    found = [Adjustment(_total_words(entry), rounded(score - total))]
    found.append(Adjustment(_late_words(entry), rounded(entry.final - score)))
    return tuple(one for one in found if one.points)


def single(
    report: Report, *, penalty: float = 0, overrides: Sequence[Override] = ()
) -> GradebookEntry:
    """Return the entry of a report that stands alone, outside of a class."""
    who = report.submission
    entry = GradebookEntry(
        student=Student(key=who.student_id or who.name, name=who.name),
        status="graded" if report.status == "graded" else "pending",
        report=report,
        penalty=penalty,
        max_score=report.max_score,
        overrides=tuple(overrides),
        lang=report.lang,
    )
    if report.status != "graded":
        return entry
    whole = {override.check: override.points for override in overrides}.get("")
    score = sum(mark.points or 0 for mark in marks(entry)) if whole is None else whole
    return replace(entry, score=rounded(score), final=rounded(max(score - penalty, 0)))


def _mark(check: CheckResult, override: Override | None) -> Mark:
    if override is not None:
        return Mark(check, rounded(override.points), override)
    return Mark(check, None if check.status in OPEN else rounded(check.score))


def _total_words(entry: GradebookEntry) -> str:
    whole = {override.check: override for override in entry.overrides}.get("")
    if whole is None:
        return say("The total was corrected")
    by, why = _named(whole), one_line(whole.because)
    if not by:
        return say("The total was corrected, because: {why}", why=why)
    return say("The total was corrected by {name}, because: {why}", name=by, why=why)


def _late_words(entry: GradebookEntry) -> str:
    if entry.late_seconds > 0:
        return say("Handed in {duration} late", duration=duration(entry.late_seconds))
    if entry.penalty:
        return say("Points taken for lateness")
    return say("By the assignment's policy")


def _named(override: Override) -> str:
    return one_line(override.by, most=100) if override.by else ""
