"""The instructor's file of a course (`--course`): its lessons with due dates, weights and files."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field

from grader.base.part import Part
from grader.base.positioned_yaml import Loc, read_yaml
from grader.base.yaml_model import Fault, error_of, validated
from grader.course.assignment import Assignment
from grader.course.policy import Late, Policy, policy_faults

Weight = Annotated[float, Field(ge=0, le=1000, strict=False)]
FILES = ("roster", "worksheet", "canvas", "join", "extensions", "times")
POLICY = ("due", "time_zone", "grace", "late", "attempts", "missing")


class LessonPart(Part):
    """A lesson of the course; what is not said is as in its assignment.

    `assignment` is its id or file if that is not the lesson's key; `submissions` the download
    (default: the folder or archive of the lesson's key in PATH); `out` the folder of its output
    (default: the one of the lesson's key in --out): name the one that has marked it so far.
    """

    assignment: str = ""
    submissions: str = ""
    out: str = ""
    weight: Weight = 1
    due: datetime | None = None
    grace: str = ""
    late: Late | None = None
    attempts: Literal["best", "last", "first"] | None = None
    missing: Literal["zero", "none"] | None = None
    worksheet: str = ""
    canvas: str = ""
    join: str = ""
    times: str = ""


class CoursePart(Part):
    """The content of the file."""

    schema_: Literal[1] = Field(alias="schema")
    title: str = ""
    time_zone: str = ""
    roster: str = ""
    extensions: str = ""
    attempts: Literal["best", "last", "first"] | None = None
    missing: Literal["zero", "none"] | None = None
    lessons: dict[str, LessonPart | None] = Field(min_length=1)


@dataclass(frozen=True)
class CourseLesson:
    """A lesson: its files by option, and how its assignment is changed."""

    name: str
    assignment: str
    submissions: Path | None
    out: Path | None
    weight: float
    files: Mapping[str, Path]
    policy: Mapping[str, Any]

    def of(self, assignment: Assignment) -> Assignment:
        """Return the assignment with the due date and policy of the course."""
        own = assignment.policy.model_dump(exclude_unset=True)
        return assignment.model_copy(
            update={"policy": Policy.model_validate({**own, **self.policy})}
        )


@dataclass(frozen=True)
class CoursePlan:
    """The lessons of a course in their order."""

    title: str
    lessons: tuple[CourseLesson, ...]


def read_course(path: Path) -> CoursePlan:
    """Read the file; raise AssignmentError, with file and line, if it is not as it must be.

    Paths in it are relative to its folder.
    """
    document = read_yaml(path)
    keys: dict[Loc, tuple[str, ...]] = {(): tuple(CoursePart.model_fields)}
    named = document.content.get("lessons") if isinstance(document.content, dict) else None
    for name in named if isinstance(named, dict) else ():
        keys["lessons", name] = tuple(LessonPart.model_fields)
        keys["lessons", name, "late"] = tuple(Late.model_fields)
    course = validated(document, CoursePart, keys)
    faults: list[Fault] = []
    lessons = []
    for name, part in course.lessons.items():
        one = part or LessonPart()
        lesson = _lesson(path.parent, course, name, one)
        faults += [
            (("lessons", name, *place), text)
            for place, text in policy_faults(Policy.model_validate(lesson.policy))
            if place[0] != "late" or one.late is not None
        ]
        for option, file in lesson.files.items():
            if not file.is_file():
                place = ("lessons", name, option) if option in one.model_fields_set else (option,)
                faults.append((place, f"there is no file {file}"))
        if lesson.submissions is not None and not lesson.submissions.exists():
            place = ("lessons", name, "submissions")
            faults.append((place, f"there is no folder or archive {lesson.submissions}"))
        lessons.append(lesson)
    if faults:
        raise error_of(document, faults)
    return CoursePlan(course.title or path.stem, tuple(lessons))


def _lesson(folder: Path, course: CoursePart, name: str, one: LessonPart) -> CourseLesson:
    given: dict[str, Any] = {}
    for field in POLICY:
        value = getattr(one, field, None) or getattr(course, field, None)
        if value:
            given[field] = (
                value.model_dump(exclude_unset=True) if isinstance(value, Late) else value
            )
    files = {
        option: folder / (getattr(one, option, "") or getattr(course, option, ""))
        for option in FILES
        if getattr(one, option, "") or getattr(course, option, "")
    }
    return CourseLesson(
        name=name,
        assignment=one.assignment or name,
        submissions=folder / one.submissions if one.submissions else None,
        out=folder / one.out if one.out else None,
        weight=one.weight,
        files=files,
        policy=given,
    )
