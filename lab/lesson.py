"""The lesson that a lab is opened for: which one it is, and where the lab has it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.i18n.message import say
from grader.course.find import COURSE, FILE, LESSON, assignment_file, is_file, own_course

INSIDE = "/opt/ros2_teaching_lab/course"


@dataclass(frozen=True)
class OpenedLesson:
    """A lesson: its assignment's `file` on this machine; `own` if it is of our own course.

    The lab has our own course in any case. Of another course it is given this lesson's folder,
    read-only, and nothing of what lies beside it.
    """

    file: Path
    own: bool

    @property
    def folder(self) -> Path | None:
        """The folder that the lab is given; None if it has the lesson already."""
        return None if self.own else self.file.parent

    @property
    def place(self) -> str:
        """Where the lab has that folder."""
        return f"{INSIDE}/{self.file.parent.name}"

    @property
    def environment(self) -> dict[str, str]:
        """The variables by which `guide`, `check`, `fix` and `explain` know the lesson."""
        if self.own:
            return {LESSON: self.file.parent.name}
        return {COURSE: INSIDE, LESSON: f"{self.place}/{self.file.name}"}


def lesson_meant(assignment: str | None) -> OpenedLesson:
    """Return the lesson that is meant (see `grader.course.find.chosen`).

    UsageError if there is no such lesson, or if its folder is all that this person has.
    """
    file = assignment_file(assignment)
    if not is_file(file):
        raise UsageError(say("there is no assignment {file}", file=str(file)))
    file = file.resolve()
    home = Path.home().resolve()
    if file.parent == home or file.parent in home.parents:
        raise UsageError(
            say("{file} is not in a folder of its own", file=str(file)),
            remedy=say("Put it into a folder that holds the lesson and nothing else."),
        )
    own = file.name == FILE and file.parent.parent == own_course().resolve()
    return OpenedLesson(file, own)
