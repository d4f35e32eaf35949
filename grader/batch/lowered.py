"""Grades that would go down if a cell that has one were filled in.

No grade goes down without the instructor's consent: a program cannot tell a class whose submissions
were half found from one of which half handed in nothing.
"""

from __future__ import annotations

from dataclasses import dataclass

from grader.base.plain_text import one_line
from grader.batch import cells
from grader.batch.model import GradebookEntry
from grader.batch.points import marks

NONE = ("", "-")  # what the systems write for no grade
ROUNDED = 0.005 + 1e-9  # the systems show two decimals


@dataclass(frozen=True)
class Lowered:
    """A grade that would go down; `after` is "" if it would be removed."""

    key: str
    who: str
    where: str
    before: str
    after: str

    def __str__(self) -> str:
        return f"{self.who}: {self.before} in {self.where}, {self.after or 'nothing'} now"


def lowered(entry: GradebookEntry, before: str, where: str) -> Lowered | None:
    """Return the grade that an entry would lower in a cell, None if it would not.

    Replacing a grade that is not a number counts as lowering it. Points that an instructor's
    correction takes do not count.
    """
    if before.strip() in NONE or any(override.check == "" for override in entry.overrides):
        return None
    number = as_number(before)
    if entry.status == "ungradable" and number is not None and number <= 0:
        return None  # (an earlier grader gave no points for what it could not open)
    if number is not None and entry.final is not None:
        taken = sum(
            max(0.0, mark.check.score - (mark.points or 0))
            for mark in (marks(entry) if entry.overrides else ())
            if mark.override is not None
        )
        if entry.final + taken >= number - ROUNDED:
            return None
    return Lowered(
        key=entry.student.key,
        who=one_line(entry.student.name or entry.student.key, most=60),
        where=where,
        before=one_line(before, most=20),
        after=cells.number(entry.final),
    )


@dataclass(frozen=True)
class GradeChange:
    """A student's grade in one place, and the one of now ("": none)."""

    key: str
    name: str
    where: str
    before: str
    after: str


def changed(entry: GradebookEntry, before: str, where: str) -> GradeChange | None:
    """Return how an entry would change a grade, None if there is none, or the same."""
    if before.strip() in NONE:
        return None
    number = as_number(before)
    if number is not None and entry.final is not None and abs(number - entry.final) <= ROUNDED:
        return None
    name = one_line(entry.student.name or entry.student.key, most=60)
    after = cells.number(entry.final)
    return GradeChange(entry.student.key, name, where, one_line(before, most=20), after)


def is_without_verdict(entry: GradebookEntry) -> bool:
    """Whether a student has neither a submission here nor a corrected total."""
    corrected = any(override.check == "" for override in entry.overrides)
    return entry.status in ("missing", "elsewhere", "unclear") and not corrected


def as_number(text: str) -> float | None:
    """Return the number in a cell, with a decimal point or comma; None if it is not a number."""
    try:
        return float(text.strip().replace(",", "."))
    except ValueError:
        return None
