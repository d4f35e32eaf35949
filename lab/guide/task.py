"""The one thing to do next: from the last check while it holds, else from what is there now."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from grader.base.i18n.message import Message, say
from grader.course.after import hand_in
from lab.guide.action import Action
from lab.guide.builds import elsewhere, for_other_ros
from lab.guide.found import NOT_STARTED, first_mistake
from lab.guide.lesson import Step
from lab.guide.owners import OWNER, not_yours
from lab.guide.predicates import current, next_actions
from lab.guide.progress import FailedCheck, LessonProgress, archive_of
from lab.guide.runs import CHECK, stopped
from lab.guide.state import StudentState

DEPENDENCIES = "dependencies"
"""The condition whose action is the lines to add: a check says only in which file."""
STEPS_OF = {
    "package.depends": ("dependencies", "package"),
    "package.": ("package",),
    "source.exec_bit": ("node_file",),
    "source.": ("node", "node_file"),
    "entry_point.mapping": ("entry_point",),
    "build.": ("executable", "package_build"),
    "entry_point.executable": ("executable", "package_build"),
    "interface.": ("interfaces",),
}
"""The conditions of the step in which a kind of check (or all that begin so) is worked on."""


OF_FILE = {"setup.py": "entry_point", "package.xml": "package", ".py": "node"}
"""The condition of the step in which a file is written, for what a build or a run shows."""

OF_FILES = {
    *("package", "node_file", "node", "entry_point", "dependencies", "interfaces", "passes"),
}
"""The conditions about what the student writes, all of which a check with full marks has seen."""


@dataclass(frozen=True)
class Task:
    """The current step: `position` from 1, its next `action` (None: everything is done).

    `passed` is whether the files as they are had full marks, `is_checked` whether they are what the
    last check read. `of_check` is whether `action` is about what it found first. `archive` is what was made of them to hand in, if everything is done, and
    `following` says how to get to the next lesson.
    """

    position: int
    action: Action | None
    actions: tuple[Action | None, ...]
    passed: bool = False
    is_checked: bool = False
    of_check: bool = False
    archive: str = ""
    following: str = ""


def find_task(state: StudentState, steps: Sequence[Step], kept: LessonProgress) -> Task:
    """Return what to do next.

    What the last check found comes first, as long as no file that it read has changed. Then comes
    a mistake that the files show, then the first step that is not done.
    """
    is_checked = bool(kept.sha256) and kept.sha256 == state.submission.sha256
    passed = is_checked and kept.all_passed
    state = state.but(passed=passed)
    actions = list(next_actions(state, steps))
    is_begun = bool(kept.checked)
    position = current(actions, steps, is_begun=is_begun)
    if passed:  # (the checks know more of the files than the guide)
        actions = [
            None if steps[n].done.partition(" ")[0] in OF_FILES else action
            for n, action in enumerate(actions)
        ]
        position = current(actions, steps, is_begun=is_begun)
    failed = kept.failed if is_checked else None
    left = failed if failed is not None and failed.mistake in NOT_STARTED else None
    if left is not None:  # (a step that is still to do: the steps before it come first)
        failed = None
    if failed is not None:
        position = _step_of(failed.kind or failed.id, failed.file, state, steps)
        own = actions[position - 1]
        if own is None or own.id not in (DEPENDENCIES, failed.mistake):
            actions[position - 1] = _action(failed)
        else:
            actions[position - 1] = _with_hints(own, failed)
    elif not passed and (found := first_mistake(state)) is not None:
        kind, file, action = found
        position = _step_of(kind, file, state, steps)
        actions[position - 1] = actions[position - 1] or action
    if failed is None:
        position = _in_the_way(state, steps, actions, position)
    elif (foreign := not_yours(state)) is not None:
        actions[position - 1] = foreign
    now = actions[position - 1]
    if left is not None and now is not None and now.id == left.mistake:
        now = actions[position - 1] = _with_hints(now, left)
        failed = left
    if now is None and not passed:
        now = CHECK
    if kept.sha256 and not is_checked and now is not None and now.id in ("run", "ran", CHECK.id):
        changed = say("your files have changed since the last check")
        now = replace(now, found=now.found or changed)
    archive = archive_of(kept, state.saved) if now is None else ""
    of_check = failed is not None and now is not None and now.id != OWNER
    return Task(position, now, tuple(actions), passed, is_checked, of_check, archive)


def _with_hints(own: Action, failed: FailedCheck) -> Action:
    """Return the action with the hints of a check that has tried a change, if it knows more."""
    if len(failed.hints) <= len(own.hints):
        return own
    return replace(own, hints=tuple(failed.hints))


def _in_the_way(
    state: StudentState, steps: Sequence[Step], actions: list[Action | None], position: int
) -> int:
    """Put what stops every step into `actions`; return the position of the step that is current."""
    foreign = not_yours(state)
    if foreign is not None:
        actions[position - 1] = foreign
        return position
    paused = stopped(state)
    if paused is not None:
        position = _step_of("run.", "", state, steps)
        actions[position - 1] = paused
        return position
    other = for_other_ros(state)
    if other is not None:  # (in the step of the build, or in the one before it that is not done)
        position = min(position, _step_of("build.", "", state, steps))
        actions[position - 1] = other
        return position
    built_twice = elsewhere(state) if state.program.exists() else None
    if built_twice is not None:
        position = _step_of("build.", "", state, steps)
        actions[position - 1] = built_twice
    return position


def _action(failed: FailedCheck) -> Action:
    place = failed.file
    if failed.line:
        place = say("{file}, line {line}", file=failed.file, line=failed.line)
    again = say("Correct {place}, save, and run: check", place=place)
    if not place:
        again = say("Correct it, save, and run: check")
    name = failed.mistake or failed.id
    spot = f"{failed.file}:{failed.line}" if failed.line else failed.file
    return Action(again, name, failed.found, tuple(failed.hints), failed.difference, spot)


def _step_of(kind: str, file: str, state: StudentState, steps: Sequence[Step]) -> int:
    """Return the position (from 1) of the step in which a failed check is to be corrected."""
    wanted = next((names for begin, names in STEPS_OF.items() if kind.startswith(begin)), ())
    if kind == "source.node_file" and not state.node.is_file():
        wanted = ("node_file",)
    elif kind.startswith("build.") or not wanted:
        wanted = (*(name for end, name in OF_FILE.items() if file.endswith(end)), *wanted)
    places = {step.done: n for n, step in enumerate(steps, start=1)}
    for name in (f"passes {kind}", *wanted, "run"):
        if name in places:
            return places[name]
    return len(steps)


def all_done(task: Task) -> tuple[Message, Message]:
    """Return what is said when nothing is left to do in a lesson: that, and what follows."""
    return say("All steps of this lesson are done."), hand_in(task.following, task.archive)
