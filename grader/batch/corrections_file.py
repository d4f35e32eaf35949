"""A CSV file of corrections and comments: students, checks, points, reasons, comments.

All of it is read before anything is recorded: a file with an error changes nothing.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.nearest import nearest
from grader.base.plain_text import one_line, points
from grader.batch.find_student import StudentIndex
from grader.batch.given_files import GivenFile
from grader.batch.model import Student
from grader.batch.student_csv import StudentCsv
from grader.course.assignment import Assignment

WHAT = "the list of corrections"
OWN = {
    "check": ("check", "check id", "검사"),
    "points": ("points", "score", "grade", "점수"),
    "because": ("because", "reason", "이유", "사유"),
    "comment": ("comment", "comments", "feedback", "의견", "피드백"),
    "assignment": ("assignment", "assignment id", "lesson", "과제"),
    # of by-hand.csv: read by people only
    "not read": ("what", "why", "file"),
}
IGNORED = ("", "-")


@dataclass(frozen=True)
class Correction:
    """One row: points for a check ("": the total) with the reason, a comment, or both."""

    student: Student
    check: str
    points: float | None
    because: str
    comment: str

    @property
    def text(self) -> str:
        """The row in one line, for the instructor."""
        parts = []
        if self.points is not None:
            parts.append(f"{self.check or 'the total'} {points(self.points)} points")
        if self.because:
            parts.append(f"because: {one_line(self.because, most=200)}")
        if self.comment:
            parts.append(f"comment: {one_line(self.comment, most=200)}")
        return f"{self.student.name or self.student.key}: {', '.join(parts)}"


def read_corrections(
    path: Path, students: Sequence[Student], assignment: Assignment, *, force: bool = False
) -> tuple[list[Correction], list[str]]:
    """Return the corrections of a file, and notes; rows without points and comment are not read.

    Raises UsageError with the line of each error.
    """
    table = StudentCsv(GivenFile(path), WHAT, OWN, StudentIndex(students))
    table.require("points", "comment")
    found: list[Correction] = []
    seen: dict[tuple[str, str], int] = {}
    commented: dict[str, int] = {}
    for row in table.rows():
        other = table.cell(row, "assignment")
        given = table.cell(row, "points"), table.cell(row, "comment")
        if (other and other.casefold() != assignment.id.casefold()) or _is_empty(given):
            continue
        try:
            one = _correction(table, row, students, assignment, force=force)
            _refuse_twice(table, row, one, seen, commented)
            found.append(one)
        except UsageError as error:
            table.error(row, error)
    table.raise_errors("Nothing was recorded.")
    return found, table.notes


def _is_empty(given: Sequence[str]) -> bool:
    return all(text in IGNORED for text in given)


def _refuse_twice(
    table: StudentCsv,
    row: int,
    one: Correction,
    seen: dict[tuple[str, str], int],
    commented: dict[str, int],
) -> None:
    slot = one.student.key, one.check
    if one.points is not None:
        if slot in seen:
            raise UsageError(f"line {table.file.line(seen[slot])} gives points for the same")
        seen[slot] = row
    if one.comment:
        if one.student.key in commented:
            line = table.file.line(commented[one.student.key])
            raise UsageError(f"line {line} has a comment for the same student: keep one")
        commented[one.student.key] = row


def _correction(
    table: StudentCsv,
    row: int,
    students: Sequence[Student],
    assignment: Assignment,
    *,
    force: bool,
) -> Correction:
    student = students[table.student(row)]
    check, text = table.cell(row, "check"), table.cell(row, "points")
    because, comment = table.cell(row, "because"), table.text(row, "comment")
    given = None if text in IGNORED else _points(text)
    if given is not None:
        check_points(assignment, check, given, force=force)
        because = because or one_line(comment)
        if not because:
            raise UsageError("points need a reason (column 'because'): the student reads it")
    return Correction(student, check, given, because, "" if comment in IGNORED else comment)


def _points(text: str) -> float:
    try:
        found = float(text.lstrip("'").replace(",", "."))
    except ValueError:
        found = math.nan
    if not math.isfinite(found):
        raise UsageError(f"'{one_line(text, most=40)}' is not a number of points")
    return found


def check_points(assignment: Assignment, check: str, given: float, *, force: bool) -> None:
    """Raise UsageError if there is no such check, or if it is not worth so many points."""
    most = assignment.max_score if not check else _worth(assignment, check)
    if not 0 <= given <= most and not force:
        raise UsageError(
            f"{check or 'the total'} is worth 0 to {points(most)} points, not {points(given)}",
            remedy="Use --force to record it anyway.",
        )


def _worth(assignment: Assignment, check: str) -> float:
    worth = {use.id: use.points for use in assignment.checks}
    if check not in worth:
        close = nearest(check, worth)
        hint = f"Did you mean '{close}'?" if close else f"Checks: {', '.join(worth)}."
        raise UsageError(f"{assignment.id} has no check '{check}'", remedy=hint)
    return worth[check]
