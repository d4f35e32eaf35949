"""Grades that a file would lower: of a cell that holds one, and is to get less.

Nobody's grade goes down without the instructor's word: a class of whom half was not found looks, to
a program, exactly like one of whom half handed in nothing.
"""

from __future__ import annotations

from dataclasses import dataclass

from grader.base.plain_text import one_line
from grader.batch import cells
from grader.batch.model import GradebookEntry
from grader.batch.points import marks

NONE = ("", "-")  # what the systems write for no grade
ROUNDED = 0.005 + 1e-9  # they show two decimals


@dataclass(frozen=True)
class Lowered:
    """One grade that would go down: `after` is "" if it would go away."""

    key: str
    who: str
    where: str
    before: str
    after: str

    def __str__(self) -> str:
        return f"{self.who}: {self.before} in {self.where}, {self.after or 'nothing'} now"


def lowered(entry: GradebookEntry, before: str, where: str) -> Lowered | None:
    """Return what an entry would lower in a cell, None if nothing.

    A grade that is no number cannot be compared: to replace it counts as lowering it. What an
    instructor's correction takes is the instructor's word already.
    """
    if before.strip() in NONE or any(override.check == "" for override in entry.overrides):
        return None
    number = as_number(before)
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


def is_without_verdict(entry: GradebookEntry) -> bool:
    """Whether nothing was found of a student, and no correction says what he or she gets."""
    corrected = any(override.check == "" for override in entry.overrides)
    return entry.status in ("missing", "elsewhere") and not corrected


def as_number(text: str) -> float | None:
    """Return the number in a cell, with a decimal point or comma; None if it is none."""
    try:
        return float(text.strip().replace(",", "."))
    except ValueError:
        return None
