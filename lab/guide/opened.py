"""The lesson and the workspace of the lab in which a command runs."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from grader.base.i18n.translator import Translator, chosen_language
from grader.course.after import After, after_lesson
from grader.course.assignment import Assignment
from grader.course.find import GONE_ON, assignment_file, selected
from grader.course.load import load_assignment
from grader.ros.distro import DEFAULT, find_distro
from lab.guide.graph import sees
from lab.guide.lesson import Lesson, lesson_file, read_lesson
from lab.guide.progress import LessonProgress, keep_progress, read_progress
from lab.guide.ran import PROGRAM_RAN, ended_well
from lab.guide.state import StudentState
from lab.guide.task import Task, find_task
from lab.ros_packages import OPTIONAL_PACKAGES, has_package

WORKSPACE = "~/ros2_ws"
Sees = Callable[[str, str, Mapping[str, str]], bool]
"""Whether a condition of the graph holds for a node or topic, in a terminal's environment."""


@dataclass(frozen=True)
class OpenedLab:
    """What the commands share: workspace, home, distro, assignment, lesson and language."""

    workspace: Path
    home: Path
    distro: str
    assignment: Assignment
    lesson: Lesson
    translate: Translator

    def task(
        self, environment: Mapping[str, str], *, look: bool = False, sees: Sees = sees
    ) -> Task:
        """Return the current step, from the files as they are now and a terminal's environment.

        Where the step's condition is about the ROS graph, `look` asks it, which takes a second; what
        was seen is kept if the workspace can be written to. `sees` looks for who knows the graph.
        """
        kept = self.progress()
        seen = list(kept.seen)

        def key_of(condition: str, name: str) -> str:
            key = f"{condition} {name}"
            if self._is_written_here(name):  # (it holds until the student saves something else)
                key += f" {state.submission.sha256[:12]}"
            return key

        def had_seen(condition: str, name: str) -> bool:
            return key_of(condition, name) in seen

        def saw(condition: str, name: str) -> bool:
            if had_seen(condition, name):
                return True
            if condition == PROGRAM_RAN:
                holds = ended_well(self.workspace, name)
            else:
                holds = look and sees(condition, name, environment)
            if holds:
                seen.append(key_of(condition, name))
            return holds

        state = StudentState(
            self.workspace,
            self.assignment,
            environment,
            home=self.home,
            lang=self.translate.lang,
            saw=saw,
            had_seen=had_seen,
        )
        task = find_task(state, self.lesson.steps, kept)
        if task.action is None:
            task = replace(task, following=self.after().in_lab(os.environ))
        if seen != kept.seen:
            with contextlib.suppress(OSError):
                self.keep(seen=seen)
        return task

    def _is_written_here(self, name: str) -> bool:
        """Whether a node or topic comes from the student's nodes, as far as the assignment says."""
        assignment = self.assignment
        topics = {f"/{str(use.with_.get('topic', '')).lstrip('/')}" for use in assignment.checks}
        return name.rpartition("/")[2] == assignment.node_name or name in topics - {"/"}

    def after(self) -> After:
        """Return what comes after this lesson."""
        return after_lesson(self.assignment.id, lang=self.translate.lang, distro=self.distro)

    def now(self) -> OpenedLab:
        """Return the lab of the lesson that the student has gone on to, if any; else this one."""
        if not os.environ.get(GONE_ON) or selected() == self.assignment.id:
            return self
        return opened_lab(self.translate.lang, self.workspace)

    def progress(self) -> LessonProgress:
        """Return what is known of this lesson."""
        return read_progress(self.workspace).of(self.assignment.id)

    def keep(self, **changes: object) -> LessonProgress:
        """Change what is known of this lesson; see `keep_progress`."""
        return keep_progress(self.workspace, self.assignment.id, **changes)


def opened_lab(
    lang: str | None = None, workspace: Path | None = None, assignment: str | None = None
) -> OpenedLab:
    """Return the lab of this process, or of another workspace or assignment.

    Raises UsageError if there is no such lesson, or its text has no steps.
    """
    translate = Translator(lang or chosen_language(os.environ))
    distro = os.environ.get("ROS_DISTRO") or DEFAULT
    place = (workspace or Path(WORKSPACE)).expanduser()
    file = assignment_file(assignment)
    assigned = load_assignment(file).on(find_distro(distro))
    lesson = read_lesson(
        lesson_file(file.parent, translate.lang),
        distro=distro,
        packages=[name for name in OPTIONAL_PACKAGES if has_package(name, os.environ)],
    )
    return OpenedLab(place, Path.home(), distro, assigned, lesson, translate)
