"""Finds the course folder and the assignment in it; used by the commands, the guide and the lab.

A course is a folder of lessons; a lesson is a folder with an assignment.yaml. A course.yaml beside
them gives the order of the lessons, of which the first is the default.
"""

from __future__ import annotations

import contextlib
import os
from pathlib import Path
from typing import Literal

from pydantic import Field

from grader.base.errors import UsageError
from grader.base.i18n.message import say
from grader.base.part import Part
from grader.base.positioned_yaml import read_yaml
from grader.base.project import PACKAGE
from grader.base.yaml_model import validated
from grader.course.folder import COURSE, course_folder, own_course

LESSON = "GRADER_ASSIGNMENT"  # the lesson to use; the lab sets it for its programs
GONE_ON = "LAB_LESSON_FILE"
"""The lab's variable with the path of a file: the lesson of the lab, and the one after `lab next`."""
FILE = "assignment.yaml"
ORDER = "course.yaml"
KEYS = PACKAGE / "keys"


class Course(Part):
    """The content of a course.yaml."""

    schema_: Literal[1] = Field(alias="schema")
    lessons: tuple[str, ...] = Field(min_length=1)


def lessons_of(course: Path) -> list[str]:
    """Return the ids of a course's lessons: in the order of its course.yaml, then by name."""
    found = sorted(file.parent.name for file in course.glob(f"*/{FILE}"))
    order = {name: place for place, name in enumerate(order_of(course))}
    return sorted(found, key=lambda name: (order.get(name, len(order)), name))


def order_of(course: Path) -> tuple[str, ...]:
    """Return the lessons that a course.yaml names, in its order; none if there is no such file.

    Raises AssignmentError if the file is not as it must be, or names a lesson that is not there.
    """
    file = course / ORDER
    if not is_file(file):
        return ()
    document = read_yaml(file)
    names = validated(document, Course, {(): tuple(Course.model_fields)}).lessons
    for n, name in enumerate(names):
        if not is_file(course / name / FILE):
            raise document.error(("lessons", n), f"there is no lesson '{name}'")
    return names


def names_a_file(assignment: str) -> bool:
    """Whether an --assignment is a file's path and not an id."""
    return "/" in assignment or assignment.endswith((".yaml", ".yml"))


def is_file(path: Path) -> bool:
    """Whether the file exists and this user may access it."""
    return os.path.isfile(path)  # noqa: PTH113 - Path.is_file raises PermissionError


def selected() -> str:
    """Return the lesson that the environment names, or the one that the student has gone on to."""
    opened, file = os.environ.get(LESSON, ""), os.environ.get(GONE_ON)
    if file:
        with contextlib.suppress(OSError, UnicodeDecodeError):
            before, _, now = Path(file).read_text(encoding="utf-8").strip().partition(" ")
            return now if before == opened and now else opened
    return opened


def chosen(assignment: str | None) -> str:
    """Return the assignment to use, an id or a file's path.

    It is the one of the command line, else $GRADER_ASSIGNMENT, else the first of the course.yaml,
    else the course's only lesson. Raises UsageError, with a list of the lessons, if the course has
    none, or several and no course.yaml.
    """
    named = assignment or selected()
    if named:
        return named
    course = course_folder()
    known = lessons_of(course)
    if len(known) == 1 or (known and order_of(course)):
        return known[0]
    if not known:
        raise _no_course(course)
    raise UsageError(
        say("there are several lessons in {course}", course=str(course)),
        remedy=say(
            "Choose one with --assignment (make: ASSIGNMENT=…) or with ${variable}: {names}.",
            variable=LESSON,
            names=", ".join(known),
        ),
    )


def assignment_file(assignment: str | None) -> Path:
    """Return the file of an assignment: the path itself, or the file of that id in the course.

    Raises UsageError, with a list of the lessons, for an id that the course does not have and
    if `chosen` finds none.
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
            "Assignments: {names}; or give a file's path. ${variable} sets another course folder.",
            names=", ".join(known),
            variable=COURSE,
        ),
    )


def _no_course(course: Path) -> UsageError:
    path = str(course)
    if not os.path.isdir(course):  # noqa: PTH112 - see is_file
        return UsageError(
            say("there is no course folder {path}", path=path),
            remedy=say("Set ${variable} to the folder that holds the lessons.", variable=COURSE),
        )
    lesson = is_file(course / FILE)
    return UsageError(
        say("{path} is a lesson, not a course", path=path)
        if lesson
        else say("there is no lesson in the course folder {path}", path=path),
        remedy=say("Set ${variable} to the folder above it.", variable=COURSE)
        if lesson
        else say("A lesson is a folder with an {file}.", file=FILE),
    )


def own_keys(file: Path) -> Path | None:
    """Return the instructor's folder of a lesson of our own course; None for other courses."""
    folder = file.resolve().parent
    return KEYS / folder.name if folder.parent == own_course().resolve() else None
