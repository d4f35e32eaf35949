"""A CSV file for Moodle's gradebook import (grade/import/csv): any header, one grade per student.

One unknown user aborts the whole import, so a student without an identifier is left out, and so is
one whose identifier a spreadsheet would run as a formula. A student without a final grade is left
out too: `-` or an empty cell would remove the grade in the gradebook.
"""

from __future__ import annotations

import csv
import io
from collections import Counter
from typing import Literal

from grader.batch import cells
from grader.batch.model import ClassResult, Comment, GradebookEntry, Student
from grader.batch.sheet import Filled

By = Literal["id_number", "email", "username"]
HEADS: dict[By, str] = {
    "id_number": "ID number",
    "email": "Email address",
    "username": "Username",
}


def moodle_import(result: ClassResult, comment: Comment, *, by: By | None = None) -> Filled:
    """Return the file; `by` is the students' identifier (default: the one that most have)."""
    column = best_identity(result) if by is None else by
    counts = Counter(_identity(entry.student, column) for entry in result.entries)
    out = io.StringIO()
    table = csv.writer(out)
    title = cells.text(result.title or result.assignment)
    table.writerow([HEADS[column], "Full name", title, "Feedback"])
    warnings = []
    for entry in result.entries:
        if entry.final is None or entry.keeps_grade:
            continue
        value = _identity(entry.student, column)
        if not value or counts[value] > 1 or not cells.is_plain(value):
            warnings.append(_left_out(entry, column, value))
            continue
        name, grade = cells.text(entry.student.name), cells.number(entry.final)
        table.writerow([value, name, grade, comment(entry)])
    return Filled(out.getvalue().encode(), tuple(warnings))


def best_identity(result: ClassResult) -> By:
    """Return the identifier that most students have; ID number before email before user name."""
    order: tuple[By, ...] = ("id_number", "email", "username")
    students = [entry.student for entry in result.entries]
    return max(order, key=lambda by: sum(bool(_identity(one, by)) for one in students))


def _identity(student: Student, by: By) -> str:
    return str(getattr(student, by)).strip()


def _left_out(entry: GradebookEntry, by: By, value: str) -> str:
    who = cells.text(entry.student.name or entry.student.key, most=100)
    why = f"has no {HEADS[by]}" if not value else f"has an unusable {HEADS[by]}"
    return f"{who} {why}: left out of the gradebook import"
