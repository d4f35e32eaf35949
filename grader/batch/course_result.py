"""The result of a course: each student's points in every lesson, and the total."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field

from grader.batch.match import written_names
from grader.batch.model import ClassResult, GradebookEntry, Student

PERCENT = 100


@dataclass(frozen=True)
class LessonResult:
    """A lesson that was marked: its weight, and where its pages are (relative to the course's)."""

    name: str
    weight: float
    result: ClassResult
    place: str = ""


@dataclass
class CourseRow:
    """A student of the course: the entry of each lesson by its name."""

    student: Student
    entries: dict[str, GradebookEntry] = field(default_factory=dict)
    unsure: list[str] = field(default_factory=list)
    """Lessons in which several of that name are known: their entries stand in other rows."""

    def percent(self, lessons: Sequence[LessonResult]) -> float | None:
        """Return the weighted share of the lessons with a grade, in percent; None without any.

        A lesson without a grade does not count: whether it is a zero is said by its policy.
        """
        graded = list(self.graded(lessons))
        weight = sum(lesson.weight for lesson, _ in graded)
        if not weight:
            return None
        return PERCENT * sum(lesson.weight * share for lesson, share in graded) / weight

    def graded(self, lessons: Sequence[LessonResult]) -> Iterator[tuple[LessonResult, float]]:
        """Yield the lessons with a grade, each with the student's share of its points."""
        for lesson in lessons:
            entry = self.entries.get(lesson.name)
            if entry is not None and entry.final is not None and entry.max_score:
                yield lesson, entry.final / entry.max_score


@dataclass(frozen=True)
class CourseResult:
    """All students of a course, in the order of the first lesson that has them."""

    title: str
    lessons: tuple[LessonResult, ...]
    rows: tuple[CourseRow, ...]
    waiting: tuple[str, ...] = ()
    """Lessons of which there are no submissions yet."""


def course_result(
    title: str, lessons: Sequence[LessonResult], waiting: Sequence[str] = ()
) -> CourseResult:
    """Join the lessons' students: by email address, number or user name, else by a name of one.

    A name that several students have joins nobody.
    """
    rows: list[CourseRow] = []
    for lesson in lessons:
        entries = lesson.result.entries
        known = _known(rows)
        names = _counts(name for row in rows for name in _names(row.student))
        own = _counts(name for entry in entries for name in _names(entry.student))
        single = {name for name, count in names.items() if count == own.get(name) == 1}
        for entry in entries:
            row = _row(entry.student, known, rows, single)
            if row is None or lesson.name in row.entries:
                row = CourseRow(entry.student)
                if any(
                    names.get(name, 0) or own.get(name, 0) > 1 for name in _names(entry.student)
                ):
                    row.unsure.append(lesson.name)
                rows.append(row)
            row.student = _more(row.student, entry.student)
            row.entries[lesson.name] = entry
    return CourseResult(title, tuple(lessons), tuple(rows), tuple(waiting))


def _row(
    student: Student,
    known: dict[tuple[str, str], int],
    rows: Sequence[CourseRow],
    single: Collection[str],
) -> CourseRow | None:
    found = {known[word] for word in _sure(student) if word in known}
    if len(found) == 1:
        return rows[found.pop()]
    if found:
        return None
    by_name = {known["name", name] for name in _names(student) if name in single}
    if len(by_name) != 1:
        return None
    row = rows[by_name.pop()]
    return None if _differ(row.student, student) else row


def _differ(one: Student, other: Student) -> bool:
    """Whether two students of one name have an address, number or user name that differs."""
    pairs = dict(_sure(one)), dict(_sure(other))
    return any(pairs[1].get(kind, word) != word for kind, word in pairs[0].items())


def _known(rows: Sequence[CourseRow]) -> dict[tuple[str, str], int]:
    found: dict[tuple[str, str], int] = {}
    for n, row in enumerate(rows):
        words = [*_sure(row.student), *(("name", name) for name in _names(row.student))]
        found.update(dict.fromkeys(words, n))
    return found


def _sure(student: Student) -> list[tuple[str, str]]:
    words = {
        "email": student.email,
        "id": student.id_number,
        "user": student.username,
    }
    return [(kind, word.casefold()) for kind, word in words.items() if word]


def _names(student: Student) -> list[str]:
    return list(dict.fromkeys(written_names(student))) or [student.key.casefold()]


def _counts(words: Iterator[str]) -> dict[str, int]:
    found: dict[str, int] = {}
    for word in words:
        found[word] = found.get(word, 0) + 1
    return found


def _more(one: Student, other: Student) -> Student:
    """Return a student with what the other lesson knows besides."""
    return Student(
        one.key,
        one.name or other.name,
        one.email or other.email,
        one.username or other.username,
        one.id_number or other.id_number,
        one.section or other.section,
    )
