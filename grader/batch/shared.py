"""One submission of several students (a group's): marked once, and the verdict is everybody's."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence

from grader.batch.intake import Item
from grader.batch.ledger import Ledger
from grader.batch.model import Student
from grader.package.intake.naming import sanitise
from grader.report.model import Report

Pair = tuple[str, str]  # a student's key, and the key of a verdict


def together(items: Iterable[Item]) -> list[list[Item]]:
    """Return the attempts that can be marked, those of one submission in one list."""
    found: dict[Pair, list[Item]] = {}
    for item in items:
        if item.key:
            found.setdefault((os.fspath(item.handed_in.path), item.key), []).append(item)
    return list(found.values())


def give_known(ledger: Ledger, items: Iterable[Item]) -> None:
    """Give who has come into a group since it was marked the verdict that the group has."""
    groups = [group for group in together(items) if len(group) > 1]
    if not groups:
        return
    verdicts, asked = ledger.verdicts(), ledger.asked_again()
    for group in groups:
        pairs = {(item.student, item.key): item for item in group}
        rows = [verdicts[pair] for pair in pairs if pair in verdicts and pair not in asked]
        without = [item for pair, item in pairs.items() if pair not in verdicts]
        if rows and without:
            report = ledger.report(max(row.id for row in rows))
            students = [item.handed_in.student for item in without]
            ledger.record_for_all(group[0].key, reports_of(report, students))


def reports_of(report: Report, students: Sequence[Student]) -> Mapping[str, Report]:
    """Return each student's own copy of a report, by the student's key."""
    return {
        student.key: report.model_copy(
            update={"submission": report.submission.model_copy(update=_who(student))}
        )
        for student in students
    }


def _who(student: Student) -> dict[str, str]:
    name = sanitise(student.name or student.key)
    return {"name": name, "student_id": student.id_number or student.key}
