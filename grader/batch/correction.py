"""Which verdict a correction belongs to, and whether it still holds."""

from __future__ import annotations

import json

from grader.base.errors import UsageError
from grader.batch.ledger import Ledger
from grader.batch.model import ClassResult, Override
from grader.report.model import Report


def holds(ledger: Ledger, override: Override, verdict: int | None, submission: str) -> bool:
    """Whether a correction holds for an attempt: its verdict's id, and its submission's hash.

    It holds if the same files are marked again, because an instructor corrects what a student handed
    in. If the assignment has changed too, the points that were corrected must still be the same.
    """
    if not verdict:
        return override.verdict == 0 or override.submission == submission != ""
    if override.verdict == verdict:
        return True
    if override.submission != submission:
        return False
    before, now = ledger.report(override.verdict), ledger.report(verdict)
    if before.assignment.sha256 == now.assignment.sha256:
        return True
    return _points_of(before, override.check) == _points_of(now, override.check)


def note_counting(ledger: Ledger, result: ClassResult) -> None:
    """Record the verdict that counts for each student, which the next correction is about."""
    counting = {
        **_noted(ledger, result.assignment),
        **{e.student.key: e.verdict or 0 for e in result.entries if e.status != "pending"},
    }
    text = json.dumps(counting, sort_keys=True)
    if text != ledger.setting(_name(result.assignment)):
        ledger.note(_name(result.assignment), text)


def counting_verdict(ledger: Ledger, assignment: str, student: str) -> int:
    """Return the id of the verdict that counts for a student, 0 if there is none.

    Raises UsageError if the ledger of an earlier grader has several attempts and does not say which.
    """
    noted = _noted(ledger, assignment)
    if student in noted:
        return noted[student]
    rows = [row for row in ledger.handed_in(assignment) if row.student == student]
    found = [ledger.verdict_of(assignment, student, row.submission) for row in rows]
    ids = [row.id for row in found if row is not None]
    if len(ids) > 1:
        raise UsageError(
            f"the ledger does not say which of the {len(ids)} attempts counts",
            remedy="Run the same `grader grade-all` once more, then correct it.",
        )
    return ids[0] if ids else 0


def _noted(ledger: Ledger, assignment: str) -> dict[str, int]:
    noted: dict[str, int] = json.loads(ledger.setting(_name(assignment)) or "{}")
    return noted


def _name(assignment: str) -> str:
    return f"counting verdicts of {assignment}"


def _points_of(report: Report, check_id: str) -> tuple[float, float] | None:
    """Return the points of a check ("": of all) and its maximum; None without such a check."""
    if not check_id:
        return report.score, report.max_score
    found = (check for check in report.checks if check.id == check_id)
    return next(((check.score, check.max_score) for check in found), None)
