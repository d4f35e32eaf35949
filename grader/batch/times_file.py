"""`times.csv`: when files were handed in, for classes whose system does not say it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime, tzinfo
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.i18n.message import say
from grader.base.plain_text import one_line
from grader.batch.dates import instant_in
from grader.batch.find_student import StudentIndex
from grader.batch.given_files import GivenFile
from grader.batch.instructor_csv import did_you_mean
from grader.batch.join_file import by_name, composed, file_names
from grader.batch.model import ClassFolder, HandedIn, Student
from grader.batch.student_csv import StudentCsv

WHAT = "the list of times"
OWN = {
    "file": ("file", "folder", "파일"),
    "submitted": (
        *("submitted", "submitted at", "submitted on", "submission time", "time of submission"),
        *("submission timestamp", "submission date", "handed in", "time", "timestamp", "date"),
        *("제출", "제출 시각", "제출 시간", "제출 일시", "제출일"),
    ),
}


@dataclass(frozen=True)
class Place:
    """A submission: the student's key (None: all who share it) and its path."""

    key: str | None
    path: Path


def with_given_times(folder: ClassFolder, given: GivenFile, zone: tzinfo | None) -> ClassFolder:
    """Return the class with the times of submission that an instructor gives.

    They count before those of the system, and before its word that a submission is late. Raises
    UsageError with the lines whose file, student or time is not known.
    """
    students = _students(folder)
    table = StudentCsv(given, WHAT, OWN, StudentIndex(students))
    table.require("submitted")
    finder = _Finder(folder.handed_in, students, table)
    times: dict[Place, datetime] = {}
    lines: dict[Place, int] = {}
    without = 0
    for row in table.rows():
        try:
            text = table.cell(row, "submitted")
            if not text:
                continue
            at = instant_in(text, zone)
            place = finder.place(row)
            if place is None:
                without += 1
                continue
            if place in times and times[place] != at:
                line = table.file.line(lines[place])
                raise UsageError(f"line {line} has another time for the same submission")
            times[place], lines[place] = at, row
        except UsageError as error:
            table.error(row, error)
    table.raise_errors()
    note = say(
        "{count} times of submission are from {file}, {without} of its students have no submission "
        "here",
        count=len(times),
        file=table.file.name,
        without=without,
    )
    notes = [*table.notes, note]
    handed_in = tuple(_with_time(one, times) for one in folder.handed_in)
    return replace(folder, handed_in=handed_in, notes=(*folder.notes, *notes))


class _Finder:
    """Finds the submission that a row is about."""

    def __init__(
        self, handed_in: Sequence[HandedIn], students: Sequence[Student], table: StudentCsv
    ) -> None:
        self._table, self._students = table, students
        names = file_names(one.path for one in handed_in)
        self._names = by_name(names)
        self._own: dict[str, list[Path]] = {}
        for one in handed_in:
            self._own.setdefault(one.student.key, []).append(one.path)

    def place(self, row: int) -> Place | None:
        """Return the submission of a row, None if its student has none."""
        file = self._table.cell(row, "file")
        if file:
            path = self._names.get(composed(file))
            if path is None:
                near = did_you_mean(file, self._names)
                raise UsageError(f"there is no submission '{one_line(file, most=80)}'{near}")
            return Place(None, path)
        student = self._students[self._table.student(row)]
        paths = self._own.get(student.key, [])
        if len(paths) > 1:
            raise UsageError(
                f"{student.name or student.key} has {len(paths)} submissions: name the one that is "
                "meant in a column 'file', as join.csv does"
            )
        return Place(student.key, paths[0]) if paths else None


def _students(folder: ClassFolder) -> list[Student]:
    found = {one.student.key: one.student for one in folder.handed_in}
    return [*found.values(), *folder.missing]


def _with_time(one: HandedIn, times: dict[Place, datetime]) -> HandedIn:
    at = times.get(Place(one.student.key, one.path), times.get(Place(None, one.path)))
    return one if at is None else replace(one, submitted=at, late=None, late_seconds=None)
