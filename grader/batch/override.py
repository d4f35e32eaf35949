"""`grader override`: an instructor's corrections, each of the verdict that counts."""

from __future__ import annotations

import getpass
from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import datetime, timezone
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.nearest import nearest
from grader.base.plain_text import one_line, points
from grader.batch.correction import counting_verdict, holds
from grader.batch.find_student import find_student
from grader.batch.ledger import Ledger
from grader.batch.model import Override, Student
from grader.course.assignment import Assignment

LEDGER = "ledger.sqlite"
LAPSED = "; no longer applies: another verdict counts now"


def find_ledger(ledger: Path | None, out: Path | None, here: Path) -> Path:
    """Return the ledger that was named, or the only one below `reports`.

    Raises UsageError if there is none, or more than one.
    """
    if ledger is not None:
        return ledger
    if out is not None:
        return out / LEDGER
    found = sorted(here.glob(f"reports/*/{LEDGER}"))
    if len(found) == 1:
        return found[0]
    if not found:
        raise UsageError(
            f"there is no ledger below {here / 'reports'}",
            remedy="Mark a class first (grader grade-all), or name its ledger with --ledger.",
        )
    names = ", ".join(str(path) for path in found)
    raise UsageError(f"there are several ledgers: {names}", remedy="Name one with --ledger.")


def put(
    ledger: Ledger,
    assignment: Assignment,
    word: str,
    check: str,
    points_given: float,
    because: str,
    *,
    force: bool,
    notify: Callable[[str], None],
) -> None:
    """Record a correction; `check` "" corrects the total."""
    student = find_student(word, _students(ledger, assignment.id))
    most = _most(assignment, check)
    if not 0 <= points_given <= most and not force:
        raise UsageError(
            f"{check or 'the total'} is worth 0 to {points(most)} points, not "
            f"{points(points_given)}",
            remedy="Use --force to record it anyway.",
        )
    if not because.strip():
        raise UsageError("a reason is needed: --because TEXT", remedy="The student reads it.")
    verdict = counting_verdict(ledger, assignment.id, student.key)
    now = datetime.now(timezone.utc)
    made = Override(student.key, check, points_given, because.strip(), _user(), now, verdict)
    ledger.override(assignment.id, made)
    what = check or "the total"
    notify(f"{student.name or student.key}: {what} now has {points(points_given)} points")


def remove(
    ledger: Ledger, assignment: Assignment, word: str, check: str, *, notify: Callable[[str], None]
) -> None:
    """Remove a correction: that of the verdict that counts, or else the last one of another."""
    student = find_student(word, _students(ledger, assignment.id))
    own = [o for o in ledger.overrides(assignment.id) if o.student == student.key]
    fit = [override for override in own if override.check == check]
    if not fit:
        named = ", ".join(override.check or "the total" for override in own) or "nothing"
        raise UsageError(
            f"{check or 'the total'} of {student.name or student.key} was not corrected",
            remedy=f"Corrected for this student: {named}.",
        )
    counts = [override for override in fit if _holds(ledger, assignment, override)]
    last = (counts or fit)[-1]
    now = datetime.now(timezone.utc)
    ledger.drop_override(assignment.id, replace(last, because="taken back", by=_user(), at=now))
    what = f"{check or 'the total'}{'' if counts else ' of an earlier verdict'}"
    notify(f"{student.name or student.key}: {what} is no longer corrected")


def listed(ledger: Ledger, assignment: Assignment) -> list[str]:
    """Return a line for every correction that was not removed."""
    names = {student.key: student.name for student in _students(ledger, assignment.id)}
    return [
        f"{names.get(o.student) or o.student}: {o.check or 'the total'} "
        f"{points(o.points)} points, because: {one_line(o.because)}"
        f" ({o.by}, {o.at:%Y-%m-%d %H:%M} UTC)"
        f"{'' if _holds(ledger, assignment, o) else LAPSED}"
        for o in ledger.overrides(assignment.id)
    ]


def _holds(ledger: Ledger, assignment: Assignment, override: Override) -> bool:
    """Whether a correction is about the verdict that counts."""
    try:
        verdict = counting_verdict(ledger, assignment.id, override.student)
    except UsageError:  # it is not known
        return False
    return holds(ledger, override, verdict, ledger.submission_of(verdict))


def _user() -> str:
    try:
        return getpass.getuser()
    except (KeyError, OSError):  # a container may have no name for its user
        return ""


def _students(ledger: Ledger, assignment: str) -> Sequence[Student]:
    return ledger.students(assignment)


def _most(assignment: Assignment, check: str) -> float:
    if not check:
        return assignment.max_score
    worth = {use.id: use.points for use in assignment.checks}
    if check not in worth:
        close = nearest(check, worth)
        hint = f"Did you mean '{close}'?" if close else f"Checks: {', '.join(worth)}."
        raise UsageError(f"{assignment.id} has no check '{check}'", remedy=hint)
    return worth[check]
