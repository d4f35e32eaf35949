"""The lesson and the workspace of the lab in which a command runs."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from grader.base.i18n.message import say
from grader.base.i18n.translator import Translator, chosen_language
from grader.course.assignment import Assignment
from grader.course.find import assignment_file
from grader.course.load import load_assignment
from grader.ros.distro import DEFAULT, find_distro
from lab.guide.action import Action
from lab.guide.graph import sees
from lab.guide.lesson import Lesson, lesson_file, read_lesson
from lab.guide.predicates import current, next_actions
from lab.guide.progress import FailedCheck, LessonProgress, keep_progress, read_progress
from lab.guide.state import StudentState

WORKSPACE = "~/ros2_ws"


@dataclass(frozen=True)
class Task:
    """The current step: `position` from 1, its next `action` (None: everything is done)."""

    position: int
    action: Action | None
    actions: tuple[Action | None, ...]


@dataclass(frozen=True)
class OpenedLab:
    """What the commands share: workspace, home, distro, assignment, lesson and language."""

    workspace: Path
    home: Path
    distro: str
    assignment: Assignment
    lesson: Lesson
    translate: Translator

    def task(self, environment: Mapping[str, str], *, look: bool = False) -> Task:
        """Return the current step, from the files as they are now and a terminal's environment.

        Where the step's condition is about the ROS graph, `look` asks it, which takes a second; what
        was seen is kept if the workspace can be written to.
        """
        kept = self.progress()
        seen = list(kept.seen)

        def saw(condition: str, name: str) -> bool:
            if (key := f"{condition} {name}") in seen:
                return True
            if not (look and sees(condition, name, environment)):
                return False
            seen.append(key)
            return True

        state = StudentState(
            self.workspace,
            self.assignment,
            environment,
            home=self.home,
            passed=kept.passed,
            lang=self.translate.lang,
            failed=_action(kept.failed) if kept.failed is not None else None,
            saw=saw,
        )
        actions = next_actions(state, self.lesson.steps)
        if seen != kept.seen:
            with contextlib.suppress(OSError):
                self.keep(seen=seen)
        position = current(actions)
        return Task(position, actions[position - 1], actions)

    def progress(self) -> LessonProgress:
        """Return what is known of this lesson."""
        return read_progress(self.workspace).of(self.assignment.id)

    def keep(self, **changes: object) -> LessonProgress:
        """Change what is known of this lesson; see `keep_progress`."""
        return keep_progress(self.workspace, self.assignment.id, **changes)


def _action(failed: FailedCheck) -> Action:
    again = say("Correct it, save, and run: check")
    return Action(again, failed.id, found=failed.found, hints=tuple(failed.hints))


def opened_lab(
    lang: str | None = None, workspace: Path | None = None, assignment: str | None = None
) -> OpenedLab:
    """Return the lab of this process, or of another workspace or assignment.

    Raises UsageError if there is no such lesson, or its text has no steps.
    """
    translate = Translator(lang or chosen_language(os.environ))
    distro = os.environ.get("ROS_DISTRO") or DEFAULT
    file = assignment_file(assignment)
    assigned = load_assignment(file).on(find_distro(distro))
    lesson = read_lesson(lesson_file(file.parent, translate.lang), distro=distro)
    place = workspace or Path(WORKSPACE)
    return OpenedLab(place.expanduser(), Path.home(), distro, assigned, lesson, translate)
