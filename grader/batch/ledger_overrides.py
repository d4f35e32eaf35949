"""Reads the corrections of a ledger, and finds the verdict that each of them is about.

A row of an earlier grader does not say so. If the student had handed in one submission by then, it
is the last verdict on that; of several, nobody can know which one was meant.
"""

from __future__ import annotations

from datetime import datetime

from grader.batch.ledger_file import LedgerFile
from grader.batch.model import UNKNOWN, Override

QUERY = """
    SELECT override.student, check_id, points, because, by, at, override.verdict,
        coalesce(verdict.submission, '')
    FROM override LEFT JOIN verdict ON verdict.id = override.verdict
    WHERE override.assignment = ? ORDER BY override.id
"""
BEFORE = """
    SELECT id, submission FROM verdict
    WHERE assignment = ? AND student = ? AND marked <= ? ORDER BY id
"""


def recorded_overrides(file: LedgerFile, assignment: str) -> list[Override]:
    """Return the last correction of each student, check and submission that was not removed."""
    found: dict[tuple[str, str, str, int], Override] = {}
    for student, check, points, because, by, at, verdict, submission in file.rows(
        QUERY, (assignment,)
    ):
        about = verdict, submission
        if verdict is None:  # an earlier grader kept one correction of a student and check
            found = {slot: one for slot, one in found.items() if slot[:2] != (student, check)}
            about = _meant(file, assignment, student, at)
        # the verdicts on one submission share its correction
        slot = (student, check, about[1], 0 if about[1] else about[0])
        found.pop(slot, None)
        if points is not None:
            when = datetime.fromisoformat(at)
            found[slot] = Override(student, check, points, because, by, when, *about)
    return list(found.values())


def _meant(file: LedgerFile, assignment: str, student: str, at: str) -> tuple[int, str]:
    """Return the id and the submission of the verdict that a correction can only be about."""
    rows = file.rows(BEFORE, (assignment, student, at))
    submissions = {submission for _, submission in rows}
    if not rows:
        return 0, ""
    return (rows[-1][0], rows[-1][1]) if len(submissions) == 1 else (UNKNOWN, "")
