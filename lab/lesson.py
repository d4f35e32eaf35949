"""The lesson that a lab is opened for, and its path in the lab."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.i18n.message import say
from grader.base.nearest import meant, nearest_path
from grader.course.find import COURSE, FILE, LESSON, assignment_file, is_file, own_course

INSIDE = "/opt/ros2_teaching_lab/course"


@dataclass(frozen=True)
class OpenedLesson:
    """A lesson: its assignment's `file` on this machine; `own` if it belongs to our own course.

    The lab always contains our own course. Of another course, only this lesson's folder is mounted,
    read-only.
    """

    file: Path
    own: bool

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


def chosen_lesson(assignment: str | None) -> OpenedLesson:
    """Return the chosen lesson (see `grader.course.find.chosen`).

    UsageError if there is no such lesson, or if its folder contains the user's home folder.
    """
    file = assignment_file(assignment)
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
    return OpenedLesson(file, own)
