"""`grader override`: an instructor's corrections, each of the verdict that counts."""

from __future__ import annotations

import getpass
from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import datetime, timezone
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.plain_text import one_line, points
from grader.batch.correction import counting_verdict, holds
from grader.batch.corrections_file import Correction
from grader.batch.find_student import find_student
from grader.batch.ledger import Ledger
from grader.batch.model import Override, Remark, Student
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


def record(ledger: Ledger, assignment: Assignment, rows: Sequence[Correction]) -> int:
    """Record what is not recorded yet, and return of how many rows that was anything."""
    verdicts = {
        one.student.key: counting_verdict(ledger, assignment.id, one.student.key) for one in rows
    }
    known = ledger.overrides(assignment.id)
    remarks, now, count = ledger.remarks(assignment.id), datetime.now(timezone.utc), 0
    for one in rows:
        key, is_new = one.student.key, False
        submission = ledger.submission_of(verdicts[key])
        if one.points is not None:
            made = Override(key, one.check, one.points, one.because, _user(), now, verdicts[key])
            if not any(_is_same(made, other) for other in known):
                ledger.override(assignment.id, made)
                is_new = True
        if one.comment:
            remark = Remark(key, one.comment, _user(), now, submission)
            before = remarks.get(key)
            if before is None or (before.text, before.submission) != (one.comment, submission):
                ledger.remark(assignment.id, remark)
                is_new = True
        count += is_new
    return count


def _is_same(one: Override, other: Override) -> bool:
    def what(override: Override) -> tuple[object, ...]:
        return override.student, override.check, override.points, override.because, override.verdict

    return what(one) == what(other)


def drop_comment(
    ledger: Ledger, assignment: Assignment, word: str, *, notify: Callable[[str], None]
) -> None:
    """Take back what an instructor wrote to a student."""
    student = find_student(word, _students(ledger, assignment.id))
    ledger.drop_remark(assignment.id, student.key)
    notify(f"{student.name or student.key}: no comment any more")


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
    """Return a line for every correction and comment that was not removed."""
    names = {student.key: student.name for student in _students(ledger, assignment.id)}
    comments = [
        f"{names.get(one.student) or one.student}: comment: {one_line(one.text)}"
        f" ({one.by}, {one.at:%Y-%m-%d %H:%M} UTC)"
        for one in ledger.remarks(assignment.id).values()
    ]
    corrections = [
        f"{names.get(o.student) or o.student}: {o.check or 'the total'} "
        f"{points(o.points)} points, because: {one_line(o.because)}"
        f" ({o.by}, {o.at:%Y-%m-%d %H:%M} UTC)"
        f"{'' if _holds(ledger, assignment, o) else LAPSED}"
        for o in ledger.overrides(assignment.id)
    ]
    return [*corrections, *comments]


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
