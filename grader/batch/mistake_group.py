"""The students whose verdict that counts has the same mistake, and what is done with all of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from grader.base.errors import UsageError
from grader.base.nearest import nearest
from grader.batch.correction import counting_verdict
from grader.batch.ledger import Ledger
from grader.batch.model import Student


@dataclass(frozen=True)
class MistakeGroup:
    """The students with one mistake, and the checks that failed by it, the most frequent first."""

    mistake: str
    students: tuple[Student, ...]
    checks: tuple[str, ...]


def mistake_group(ledger: Ledger, assignment: str, mistake: str) -> MistakeGroup:
    """Return the students who made a mistake; raise UsageError if nobody did."""
    found: list[Student] = []
    checks: dict[str, int] = {}
    known: set[str] = set()
    for student in ledger.students(assignment):
        verdict = counting_verdict(ledger, assignment, student.key)
        if not verdict:
            continue
        failed = ledger.report(verdict).checks
        known |= {one.id for check in failed for one in check.mistakes}
        own = [check.id for check in failed if any(one.id == mistake for one in check.mistakes)]
        if own:
            found.append(student)
        for check in own:
            checks[check] = checks.get(check, 0) + 1
    if not found:
        close = nearest(mistake, known)
        named = ", ".join(sorted(known)) or "none"
        hint = f"Did you mean '{close}'?" if close else f"Mistakes in this class: {named}."
        raise UsageError(f"nobody made the mistake '{mistake}'", remedy=hint)
    frequent = sorted(checks, key=lambda check: (-checks[check], check))
    return MistakeGroup(mistake, tuple(found), tuple(frequent))


def check_of(group: MistakeGroup, check: str) -> str:
    """Return the check whose points are adjusted for a group; raise UsageError if it is not clear."""
    if check or len(group.checks) == 1:
        return check or group.checks[0]
    raise UsageError(
        f"'{group.mistake}' failed several checks: {', '.join(group.checks)}",
        remedy="Name one with --check.",
    )


def names_of(students: Sequence[Student]) -> str:
    """Return the names of students in one line."""
    return ", ".join(student.name or student.key for student in students)
