"""`grader grade-all --course`: marks each lesson of a course, and writes one gradebook of all."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from grader.base.errors import GraderError, SurroundingsError, UsageError
from grader.base.shown import shown
from grader.batch.course_file import CourseLesson, CoursePlan, read_course
from grader.batch.course_result import CourseResult, LessonResult, course_result
from grader.batch.given_files import write_private
from grader.batch.model import ClassResult
from grader.publish.class_run import ClassOptions, grade_all
from grader.publish.course_gradebook import CSV, XLSX, course_csv, course_xlsx
from grader.publish.outputs import INDEX

ARCHIVES = (".zip", ".tar", ".tar.gz", ".tgz", ".tar.xz", ".tar.bz2")
OptionsOf = Callable[[CourseLesson, Path, Path], ClassOptions]
"""Returns the options of a lesson from its submissions and its output folder."""
Notify = Callable[[str], None]


def grade_course(
    file: Path,
    path: Path,
    out: Path,
    options_of: OptionsOf,
    *,
    dry_run: bool,
    xlsx: bool,
    notify: Notify,
) -> int:
    """Mark every lesson of which there are submissions; return the worst exit status.

    A lesson that cannot be marked does not stop the others; then the gradebook of the course is not
    written, because a grade would be missing in it.
    """
    plan = read_course(file)
    results: list[LessonResult] = []
    waiting: list[str] = []
    failures: list[tuple[str, GraderError]] = []
    status = 0
    for number, lesson in enumerate(plan.lessons, start=1):
        submissions = lesson.submissions or _submissions(path, lesson.name)
        if submissions is None:
            waiting.append(lesson.name)
            continue
        notify(f"lesson {number} of {len(plan.lessons)}: {lesson.name}")
        place = lesson.out or out / lesson.name

        def heard(result: ClassResult, lesson: CourseLesson = lesson, place: Path = place) -> None:
            relative = os.path.relpath(place.resolve(), out.resolve())
            results.append(LessonResult(lesson.name, lesson.weight, result, relative))

        try:
            options = replace(options_of(lesson, submissions, place), heard=heard)
            status = max(status, grade_all(options, dry_run=dry_run))
        except (UsageError, SurroundingsError) as error:
            failures.append((lesson.name, error))
            notify(f"{lesson.name}: {error}")
    _say_waiting(plan, waiting, path, notify)
    if failures:
        raise _together(failures)
    if dry_run or not results:
        return status
    _write(course_result(plan.title, results, waiting), out, xlsx=xlsx, notify=notify)
    return status


def _submissions(path: Path, name: str) -> Path | None:
    """Return the folder or archive of a lesson, None if there is none yet."""
    places = [path / name, *(path / f"{name}{ending}" for ending in ARCHIVES)]
    found = [place for place in places if place.exists()]
    if len(found) > 1:
        names = ", ".join(place.name for place in found)
        raise UsageError(
            f"there are several downloads of {name}: {names}",
            remedy="Keep one, or name it in the course's file (submissions:).",
        )
    return found[0] if found else None


def _say_waiting(plan: CoursePlan, waiting: list[str], path: Path, notify: Notify) -> None:
    if len(waiting) == len(plan.lessons):
        raise UsageError(
            f"{shown(str(path))} has no submissions of any lesson",
            remedy=f"Put each download there under its lesson's name: {', '.join(waiting)}.",
        )
    if waiting:
        notify(f"no submissions yet: {', '.join(waiting)}")


def _together(failures: list[tuple[str, GraderError]]) -> GraderError:
    kind = (
        SurroundingsError
        if any(isinstance(error, SurroundingsError) for _, error in failures)
        else UsageError
    )
    text = "\n".join(f"{name}: {error.message}" for name, error in failures)
    remedy = "\n".join(dict.fromkeys(str(error.remedy) for _, error in failures if error.remedy))
    note = "The course's gradebook was not written; the verdicts of all lessons are kept."
    return kind(text, remedy="\n".join(part for part in (remedy, note) if part))


def _write(course: CourseResult, out: Path, *, xlsx: bool, notify: Notify) -> None:
    from grader.publish.pages.course import course_page  # noqa: PLC0415 - slow

    for row in course.rows:
        for lesson in row.unsure:
            name = row.student.name or row.student.key
            notify(f"{name} of {lesson} was not joined: several have this name (give a roster)")
    write_private(out, "", CSV, course_csv(course))
    if xlsx:
        write_private(out, "", XLSX, course_xlsx(course))
    write_private(out, "", INDEX, course_page(course))
    notify(f"course     {shown(str(out / INDEX))}")
    notify(f"gradebook  {shown(str(out / (XLSX if xlsx else CSV)))}")
