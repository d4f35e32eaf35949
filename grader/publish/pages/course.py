"""The page of a course: one table with each student's weeks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from urllib.parse import quote

from grader.base.i18n.translator import SOURCE
from grader.base.plain_text import one_line
from grader.batch.course_result import CourseResult, CourseRow
from grader.batch.model import GradebookEntry
from grader.publish.pages.names import page_names
from grader.publish.pages.render import Renderer


@dataclass(frozen=True)
class WeekCell:
    """A student's lesson: the entry, and the address of its page."""

    entry: GradebookEntry | None
    page: str


@dataclass(frozen=True)
class WeekRow:
    """A student's row."""

    row: CourseRow
    cells: tuple[WeekCell, ...]
    percent: float | None
    graded: int
    find: str


def course_page(course: CourseResult) -> bytes:
    """Return the page in UTF-8."""
    pages = {
        lesson.name: page_names(entry.student.key for entry in lesson.result.entries)
        for lesson in course.lessons
    }
    places = {lesson.name: quote(lesson.place) for lesson in course.lessons}
    lang = course.lessons[0].result.lang if course.lessons else SOURCE
    renderer = Renderer(lang=lang, heading=one_line(course.title), pages={})
    return renderer.page(
        "course.html.j2",
        script=True,
        course=course,
        places=places,
        rows=[_row(course, row, pages, places) for row in course.rows],
        sections=any(row.student.section for row in course.rows),
    )


def _row(
    course: CourseResult,
    row: CourseRow,
    pages: Mapping[str, Mapping[str, str]],
    places: Mapping[str, str],
) -> WeekRow:
    found = []
    for lesson in course.lessons:
        entry = row.entries.get(lesson.name)
        page = ""
        if entry is not None:
            page = f"{places[lesson.name]}/students/{pages[lesson.name][entry.student.key]}"
        found.append(WeekCell(entry, page))
    student = row.student
    unseen = (student.email, student.username, student.id_number)
    graded = sum(1 for _ in row.graded(course.lessons))
    find = " ".join(one_line(part, most=120) for part in unseen if part)
    return WeekRow(row, tuple(found), row.percent(course.lessons), graded, find)
