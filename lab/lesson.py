"""The lesson that a lab is opened for, and its path in the lab."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.i18n.message import say
from grader.base.nearest import meant, nearest_path
from grader.course.find import FILE, LESSON, assignment_file, is_file, lessons_of, order_of
from grader.course.folder import COURSE, course_folder, own_course
from lab.guide.progress import read_progress

INSIDE = "/opt/ros2_teaching_lab/course"


@dataclass(frozen=True)
class OpenedLesson:
    """A lesson: its assignment's `file` on this machine; `own` if it belongs to our own course.

    It was `chosen` if nobody has named it: then the student may go on with the next one in this lab.

    The lab always contains our own course. Of another course, only this lesson's folder is mounted,
    read-only.
    """

    file: Path
    own: bool
    chosen: bool = False

    @property
    def folder(self) -> Path | None:
        """The folder to mount; None if the lab contains the lesson already."""
        return None if self.own else self.file.parent

    @property
    def path_inside(self) -> str:
        """The path of that folder in the lab."""
        return f"{INSIDE}/{self.file.parent.name}"

    @property
    def environment(self) -> dict[str, str]:
        """The variables that select the lesson for `guide`, `check`, `fix` and `explain`."""
        if self.own:
            return {LESSON: self.file.parent.name}
        return {COURSE: INSIDE, LESSON: f"{self.path_inside}/{self.file.name}"}


def first_unfinished(workspace: Path) -> str | None:
    """Return the first lesson of the course that never had full marks in a workspace.

    None if the environment names a lesson, if the course has no order, or if all are finished.
    """
    course = course_folder()
    if os.environ.get(LESSON) or not order_of(course):
        return None
    kept = read_progress(workspace)
    lessons = lessons_of(course)
    return next((name for name in lessons if not kept.of(name).passed), None)


def chosen_lesson(assignment: str | None, workspace: Path | None = None) -> OpenedLesson:
    """Return the lesson that is named, else the first that is not finished in a workspace.

    If all are finished it is the default one (see `grader.course.find.chosen`). UsageError if there is no such lesson, or if its folder contains the user's home folder.
    """
    unfinished = first_unfinished(workspace) if not assignment and workspace is not None else None
    file = assignment_file(assignment or unfinished)
    if not is_file(file):
        missing = say("there is no assignment {file}", file=str(file))
        raise UsageError(missing + meant(nearest_path(file)))
    file = file.resolve()
    home = Path.home().resolve()
    if file.parent == home or file.parent in home.parents:
        raise UsageError(
            say("{file} does not have a folder of its own", file=str(file)),
            remedy=say("Put it into a folder that contains only the lesson."),
        )
    own = file.name == FILE and file.parent.parent == own_course().resolve()
    return OpenedLesson(file, own, chosen=own and unfinished is not None)
