"""Refuses what needs the instructor's consent: a roster that hardly fits, and lower grades.

Two shares are checked, each of which catches what the other cannot:
- how many submissions are on the roster (worksheet, gradebook). The roster of another class, or one
  whose columns were misread, has few of them. The list of the whole course has all submissions of
  one section, so that passes.
- how many lines of the roster would get 0 points if the policy says `missing: zero`. This catches
  one section against the whole list, if the list does not say who handed in.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING

from grader.base.errors import UsageError
from grader.base.nearest import nearest
from grader.base.plain_text import one_line
from grader.batch.model import ClassFolder, OnRoster
from grader.course.policy import Policy

if TYPE_CHECKING:
    from grader.batch.lowered import Lowered

JOIN, LOWER = "join", "lower"
KNOWN = (JOIN, LOWER)
LEAST_JOINED = 0.8  # of the submissions
MOST_ZEROS = 0.2  # of the roster's lines
MOST_NAMED = 5


def accepted(words: Sequence[str]) -> frozenset[str]:
    """Return what the instructor accepts, from comma-separated words; UsageError for others."""
    found = [word.strip() for text in words for word in text.split(",") if word.strip()]
    for word in found:
        if word not in KNOWN:
            close = nearest(word, KNOWN)
            hint = f"Did you mean '{close}'? " if close else ""
            raise UsageError(
                f"--accept does not know '{one_line(word, most=40)}'",
                remedy=f"{hint}Known: {', '.join(KNOWN)}.",
            )
    return frozenset(found)


def refuse_poor_join(
    folder: ClassFolder, sheets: Sequence[OnRoster], policy: Policy, accepts: Collection[str]
) -> None:
    """Raise UsageError if the class hardly fits its roster or one of the instructor's files."""
    if JOIN in accepts:
        return
    for found in (folder.on_roster, *sheets):
        if found is None or not found.submissions:
            continue
        joined = found.submissions - len(found.strangers)
        if joined < LEAST_JOINED * found.submissions:
            raise UsageError(
                f"only {joined} of {found.submissions} submissions are on {found.roster} "
                f"({counted(found.lines)}); at least {LEAST_JOINED:.0%} should be. "
                f"Nothing was marked or written. Not on it: {_named(found.strangers)}",
                remedy="Check that it is the list of this class, and that its columns have known "
                f"names. {_go_on(JOIN)}",
            )
    _refuse_zeros(folder, policy)


def refuse_lower(lowered: Sequence[Lowered], accepts: Collection[str], *, marked: bool) -> None:
    """Raise UsageError if a grade would go down; `marked`: there are new verdicts."""
    if not lowered or LOWER in accepts:
        return
    people = len({one.key for one in lowered})
    kept = "The verdicts are kept, and nothing" if marked else "Nothing"
    raise UsageError(
        f"{counted(people)} would get a lower grade than they have. {kept} was written. "
        f"{_named([str(one) for one in lowered], by='; ')}",
        remedy=f"Check them (grader grade PATH shows one report). {_go_on(LOWER)}",
    )


def _refuse_zeros(folder: ClassFolder, policy: Policy) -> None:
    if policy.missing != "zero" or folder.on_roster is None:
        return
    zeros = [student.name for student in folder.missing if student.key not in folder.elsewhere]
    lines = folder.on_roster.lines
    if len(zeros) > MOST_ZEROS * lines:
        raise UsageError(
            f"{len(zeros)} of {lines} students on {folder.on_roster.roster} would get 0 points: "
            "they have no submission here, and the assignment's policy says missing: zero. "
            f"Nothing was marked or written. Without a submission: {_named(zeros)}",
            remedy=f"Are these the submissions of the whole class? {_go_on(JOIN)}",
        )


def counted(students: int) -> str:
    """Return a number of students with its noun."""
    return "1 student" if students == 1 else f"{students} students"


def _go_on(what: str) -> str:
    return f"To continue anyway: --accept {what} (make: ACCEPT={what})."


def _named(names: Sequence[str], *, by: str = ", ") -> str:
    more = f"{by}and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
    return by.join(one_line(name, most=120) for name in names[:MOST_NAMED]) + more
