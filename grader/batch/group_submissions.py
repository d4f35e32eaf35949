"""A group's submission is marked once, and every member gets the verdict."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from functools import partial

from grader.batch.intake import IntakeItem
from grader.batch.ledger import Ledger
from grader.batch.model import Student
from grader.package.intake.naming import sanitise
from grader.report.model import Report

Pair = tuple[str, str]  # a student's key, and the key of a verdict


def by_submission(items: Iterable[IntakeItem]) -> list[list[IntakeItem]]:
    """Return the attempts that can be marked, one list for each submission."""
    found: dict[Pair, list[IntakeItem]] = {}
    for item in items:
        if item.key:
            found.setdefault((os.fspath(item.handed_in.path), item.key), []).append(item)
    return list(found.values())


def share_group_verdicts(ledger: Ledger, items: Iterable[IntakeItem]) -> None:
    """Record the group's verdict for members who joined after the group was marked."""
    groups = [group for group in by_submission(items) if len(group) > 1]
    if not groups:
        return
    verdicts, regrades = ledger.verdicts(), ledger.pending_regrades()
    for group in groups:
        pairs = {(item.student, item.key): item for item in group}
        rows = [verdicts[pair] for pair in pairs if pair in verdicts and pair not in regrades]
        without = [item for pair, item in pairs.items() if pair not in verdicts]
        if rows and without:
            verdict = max(row.id for row in rows)
            students = [item.handed_in.student for item in without]
            ledger.record_for_all(
                group[0].key,
                reports_for(ledger.report(verdict), students),
                evidence=partial(_evidence_for, ledger.evidence(verdict)),
            )


def _evidence_for(evidence: bytes, report: Report) -> bytes:
    from grader.verdict.evidence_file import EvidenceFile  # noqa: PLC0415 - slow, rarely needed

    return EvidenceFile.from_bytes(evidence).for_report(report).to_bytes() if evidence else b""


def reports_for(report: Report, students: Sequence[Student]) -> Mapping[str, Report]:
    """Return a copy of a report for each student, by the student's key."""
    return {
        student.key: report.model_copy(
            update={"submission": report.submission.model_copy(update=_who(student))}
        )
        for student in students
    }


def _who(student: Student) -> dict[str, str]:
    name = sanitise(student.name or student.key)
    return {"name": name, "student_id": student.id_number or student.key}
