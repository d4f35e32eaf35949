"""A course is a folder of lessons, each a folder with an assignment.yaml: which one is meant.

Everything that names an assignment finds it here: the graders' commands, the guide and the lab.
"""

from __future__ import annotations

import os
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.i18n.message import say
from grader.base.project import CHECKOUT, PACKAGE, SHARES

COURSE = "GRADER_COURSE"  # names another course folder than our own
LESSON = "GRADER_ASSIGNMENT"  # names the lesson that is meant; a lab sets it for what is in it
FILE = "assignment.yaml"
KEYS = PACKAGE / "keys"


def course_folder() -> Path:
    """Return the course folder: $GRADER_COURSE, this checkout's, or the installed package's."""
    named = os.environ.get(COURSE)
    return Path(named) if named else own_course()


def own_course() -> Path:
    """Return the course that comes with the grader."""
    places = [CHECKOUT / "lab" / "course", *(share / "course" for share in SHARES)]
    return next((place for place in places if place.is_dir()), places[0])


def lessons_of(course: Path) -> list[str]:
    """Return the ids of a course's lessons, sorted."""
    return sorted(file.parent.name for file in course.glob(f"*/{FILE}"))


def names_a_file(assignment: str) -> bool:
    """Whether an --assignment is the path of a file, and not an id."""
    return "/" in assignment or assignment.endswith((".yaml", ".yml"))


def is_file(path: Path) -> bool:
    """Whether there is a file, and one that this user may look at."""
    return os.path.isfile(path)  # noqa: PTH113 - Path.is_file raises for a folder that is closed


def chosen(assignment: str | None) -> str:
    """Return the assignment that is meant, an id or the path of a file.

    That is the one of the command line, else $GRADER_ASSIGNMENT, else the course's only lesson.
    UsageError, which lists the lessons, if the course has several or none.
    """
    named = assignment or os.environ.get(LESSON)
    if named:
        return named
    course = course_folder()
    known = lessons_of(course)
    if len(known) == 1:
        return known[0]
    if not known:
        raise _no_course(course)
    raise UsageError(
        say("there are several lessons in {course}", course=str(course)),
        remedy=say(
            "Name the one that you mean with --assignment (make: ASSIGNMENT=…), or in "
            "${variable}: {names}.",
            variable=LESSON,
            names=", ".join(known),
        ),
    )


def assignment_file(assignment: str | None) -> Path:
    """Return the file of an assignment: its id's in the course folder, or the path itself.

    UsageError, with what there is, for an id that the course does not have, and where none is
    named and the course has not just one (see `chosen`).
    """
    named = chosen(assignment)
    if names_a_file(named):
        return Path(named)
    course = course_folder()
    file = course / named / FILE
    if is_file(file):
        return file
    known = lessons_of(course)
    if not known:
        raise _no_course(course)
    raise UsageError(
        say(
            "there is no assignment '{assignment}' in {course}",
            assignment=named,
            course=str(course),
        ),
        remedy=say(
            "Assignments: {names}; or give a file's path. ${variable} names another course folder.",
            names=", ".join(known),
            variable=COURSE,
        ),
    )


def _no_course(course: Path) -> UsageError:
    path = str(course)
    if not os.path.isdir(course):  # noqa: PTH112 - as is_file
        return UsageError(
            say("there is no course folder {path}", path=path),
            remedy=say("${variable} names the folder that holds the lessons.", variable=COURSE),
        )
    lesson = is_file(course / FILE)
    return UsageError(
        say("{path} is a lesson and not a course", path=path)
        if lesson
        else say("there is no lesson in the course folder {path}", path=path),
        remedy=say("Name the folder above it in ${variable}.", variable=COURSE)
        if lesson
        else say("A lesson is a folder with an {file}.", file=FILE),
    )


def own_keys(file: Path) -> Path | None:
    """Return the instructor's folder of a lesson of our own course; None for another course's."""
    folder = file.resolve().parent
    return KEYS / folder.name if folder.parent == own_course().resolve() else None
