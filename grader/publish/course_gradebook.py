"""The gradebook of a course: a row for each student, a column for each lesson, and the total."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence

from grader.batch import cells
from grader.batch.course_result import CourseResult, CourseRow
from grader.batch.words import STATES
from grader.batch.xlsx import Cell, workbook

CSV, XLSX = "course.csv", "course.xlsx"
WHO = ("name", "email", "username", "id_number", "section")


def course_table(course: CourseResult) -> list[list[Cell]]:
    """Return the table, its header first. `percent` counts the lessons with a grade only."""
    lessons = [cells.text(lesson.name) for lesson in course.lessons]
    header: list[Cell] = [*WHO, *lessons, "percent", "graded", "without a grade"]
    most: list[Cell] = ["maximum", "", "", "", ""]
    most += [*(lesson.result.max_score for lesson in course.lessons), "", "", ""]
    weights: list[Cell] = ["weight", "", "", "", ""]
    weights += [*(lesson.weight for lesson in course.lessons), "", "", ""]
    return [header, most, weights, *(_row(course, row) for row in course.rows)]


def _row(course: CourseResult, row: CourseRow) -> list[Cell]:
    student = row.student
    who: list[Cell] = [
        cells.text(word)
        for word in (
            student.name or student.key,
            student.email,
            student.username,
            student.id_number,
            student.section,
        )
    ]
    entries = [row.entries.get(lesson.name) for lesson in course.lessons]
    finals: list[Cell] = [None if entry is None else entry.final for entry in entries]
    percent = row.percent(course.lessons)
    graded = sum(1 for _ in row.graded(course.lessons))
    return [
        *(*who, *finals),
        None if percent is None else round(percent, 2),
        float(graded),
        cells.text("; ".join(open_lessons(course, row))),
    ]


def open_lessons(course: CourseResult, row: CourseRow) -> list[str]:
    """Return the lessons without a grade, each with why."""
    found = []
    for lesson in course.lessons:
        entry = row.entries.get(lesson.name)
        if entry is None:
            found.append(f"{lesson.name}: not in this class")
        elif entry.final is None:
            found.append(f"{lesson.name}: {STATES[entry.status]}")
        if lesson.name in row.unsure:
            found.append(f"{lesson.name}: not joined, because several have this name")
    return found


def course_csv(course: CourseResult) -> bytes:
    """Return the table as CSV in UTF-8, with the byte order mark by which Excel knows it."""
    out = io.StringIO()
    table = csv.writer(out, quoting=csv.QUOTE_ALL)
    table.writerows(_texts(course_table(course)))
    return out.getvalue().encode("utf-8-sig")


def _texts(rows: Sequence[Sequence[Cell]]) -> list[list[str]]:
    return [
        [value if isinstance(value, str) else cells.number(value) for value in row] for row in rows
    ]


def course_xlsx(course: CourseResult) -> bytes:
    """Return the table as a workbook."""
    return workbook({"course": course_table(course)})
