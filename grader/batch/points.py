"""The points of each check: the report's, with the instructor's corrections.

A system that adds up its tests must reach the same total as the gradebook. `adjustments` are the
difference between the sum of the checks and the final points: a corrected total, a late penalty.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from grader.base.i18n.message import Message, joined, say
from grader.base.plain_text import one_line, points
from grader.batch.model import GradebookEntry, Override, Student
from grader.batch.words import duration
from grader.report.model import CheckResult, Report

DIGITS = 4  # after the decimal point of points, so that sums stay readable
OPEN = ("inconclusive", "error")


@dataclass(frozen=True)
class Mark:
    """A check and its points, None if it was not decided whether they are earned."""

    check: CheckResult
    points: float | None
    override: Override | None = None

    @property
    def passed(self) -> bool:
        """Whether the check passed, or was corrected to all its points."""
        if self.override is None:
            return self.check.status == "passed"
        return self.points is not None and self.points >= self.check.max_score

    @property
    def correction(self) -> str:
        """The instructor's correction and its reason in one line, "" if there is none."""
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
    """Points that are added after the checks (below 0: taken), and why."""

    why: str
    points: float

    @property
    def text(self) -> Message:
        """The adjustment in one line."""
        return joined(self.why, in_points(self.points), by=": ")


def in_points(value: float) -> Message:
    """Return a number of points with its noun."""
    return say("1 point") if value == 1 else say("{points} points", points=points(value))


def rounded(value: float) -> float:
    """Return points without floating-point noise; never -0.0."""
    return round(value, DIGITS) + 0.0


def marks(entry: GradebookEntry) -> tuple[Mark, ...]:
    """Return the marks of an entry's report, () without one; the last correction counts."""
    if entry.report is None:
        return ()
    corrected = {override.check: override for override in entry.overrides}
    return tuple(_mark(check, corrected.get(check.id)) for check in entry.report.checks)


def adjustments(entry: GradebookEntry) -> tuple[Adjustment, ...]:
    """Return the difference between the sum of the marks and the final points, () if not final."""
    if entry.final is None:
        return ()
    total = sum(mark.points or 0 for mark in marks(entry))
    score = total if entry.score is None else entry.score
    found = [Adjustment(_total_words(entry), rounded(score - total))]
    found.append(Adjustment(_late_words(entry), rounded(entry.final - score)))
    return tuple(adjustment for adjustment in found if adjustment.points)


def single(
    report: Report, *, penalty: float = 0, overrides: Sequence[Override] = ()
) -> GradebookEntry:
    """Return the entry of a single report, outside of a class."""
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
    if entry.late_seconds:
        return say("Handed in {duration} late", duration=duration(entry.late_seconds))
    if entry.penalty:
        return say("Points taken for lateness")
    return say("By the assignment's policy")


def _named(override: Override) -> str:
    return one_line(override.by, most=100) if override.by else ""
