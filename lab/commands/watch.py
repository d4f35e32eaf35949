"""`lab watch`: shows the current step, notices when it is done, and obeys single keys."""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import click

from grader.base.errors import GraderError
from grader.base.i18n.message import msg, say
from grader.base.i18n.translator import errors_in
from grader.cli import options
from lab.terminal import ignoring_interrupts

if TYPE_CHECKING:
    from lab.commands.screen import Screen
    from lab.guide.opened import OpenedLab
    from lab.guide.task import Task

TICK = 2.0  # seconds after which it looks again, e.g. for files outside of the workspace
PROGRAMS = "LAB_PROGRAMS"  # the variable with the folder of the lab's programs
TERMINAL = ".lab/terminal"  # what the last prompt of a terminal wrote: its AMENT_PREFIX_PATH


@click.command(
    help=msg(
        "Show the current step and notice when it is done. Keys: n next step, h hint, c check, "
        "l list, d difference to what is expected, w window, q quit. Use it in a second terminal "
        "(`make lab` again), beside the one in which you work."
    )
)
@options.lang
def watch(lang: str | None) -> int:
    """Watch the workspace until q is pressed; without a terminal, print the current step."""
    return watch_lesson(lang)


def watch_lesson(lang: str | None) -> int:
    """Watch the workspace; return the exit status."""
    from lab.guide.opened import opened_lab  # noqa: PLC0415 - keeps --help fast

    with errors_in(lang):
        lab = opened_lab(lang)
        if not (sys.stdin.isatty() and sys.stdout.isatty()):
            from lab.guide.show import show  # noqa: PLC0415

            show(
                None,
                lab.lesson,
                lab.task(os.environ, look=True),
                lab.translate,
            )
            return 0
        return _Watch(lab).run()


def environment_of(workspace: Path) -> dict[str, str]:
    """Return this process's environment with the ROS paths of the terminal last worked in."""
    try:
        sourced = (workspace / TERMINAL).read_text(encoding="utf-8").strip()
    except (OSError, UnicodeDecodeError):
        return dict(os.environ)
    return {**os.environ, "AMENT_PREFIX_PATH": sourced}


class _Watch:
    """A watch on a terminal: what is shown now, and the keys."""

    def __init__(self, lab: OpenedLab) -> None:
        from lab.commands.screen import Screen  # noqa: PLC0415

        self._lab = lab
        self._screen: Screen = Screen(lab)
        self._task: Task = self._look()
        self._ahead = 0  # how many steps further the shown one is
        self._keys = {
            "n": self._next,
            "h": self._hint,
            "c": self._check,
            "l": self._list,
            "d": self._difference,
            "w": self._window,
        }

    def run(self) -> int:
        """Show steps until q or Ctrl+C; return the exit status."""
        from lab.commands.events import events  # noqa: PLC0415

        self._screen.step(self._task)
        with events(self._lab.workspace, tick=TICK) as stream, self._graph_watched():
            for event in stream:
                if event == "q":
                    break
                if event in ("c", "w"):
                    with stream.paused():
                        self._keys[event]()
                elif event in self._keys:
                    self._keys[event]()
                elif event == "resize":
                    self._screen.step(self._task, ahead=self._ahead)
                elif event == "changed":
                    self._changed()
        self._screen.end()
        return 0

    def _look(self) -> Task:
        return self._lab.task(environment_of(self._lab.workspace))

    @contextlib.contextmanager
    def _graph_watched(self) -> Iterator[None]:
        """Look at the ROS graph again and again; what is seen changes the file of the progress."""
        from lab.guide.graph import CONDITIONS  # noqa: PLC0415 - keeps --help fast
        from lab.guide.ran import PROGRAM_RAN  # noqa: PLC0415

        ended = threading.Event()

        def look() -> None:
            while not ended.wait(TICK):
                with contextlib.suppress(OSError, GraderError):
                    self._lab.task(environment_of(self._lab.workspace), look=True)

        watched = (*CONDITIONS, PROGRAM_RAN, "ran", "run")
        if any(step.done.partition(" ")[0] in watched for step in self._lab.lesson.steps):
            threading.Thread(target=look, daemon=True).start()
        try:
            yield
        finally:
            ended.set()

    def _changed(self) -> None:
        """Show the step again if something about it is new, or the lesson is another one."""
        before, self._lab = self._lab, self._lab.now()
        task, old = self._look(), self._task
        moved = self._lab is not before
        if task == old and not moved:
            return
        self._task, self._ahead = task, 0
        done: list[int] = []
        if moved:
            self._screen = type(self._screen)(self._lab)
        else:
            done += [n for n in range(old.position, task.position) if task.actions[n - 1] is None]
        self._screen.step(task, done=done)

    def _next(self) -> None:
        last = len(self._lab.lesson.steps)
        self._ahead = self._ahead + 1 if self._task.position + self._ahead < last else 0
        self._screen.step(self._task, ahead=self._ahead)

    def _hint(self) -> None:
        from lab.commands.hint import next_hint  # noqa: PLC0415

        self._screen.step(self._task, more=next_hint(self._lab, self._task))

    def _check(self) -> None:
        from lab.commands.cli import main  # noqa: PLC0415

        self._screen.clear()
        main(["check"])
        self._screen.wait_for_key()
        self._task, self._ahead = self._look(), 0
        self._screen.step(self._task)

    def _list(self) -> None:
        self._screen.steps(self._task)

    def _difference(self) -> None:
        action = self._task.action
        text = action.difference if action is not None else ""
        nothing = say("There is no difference to show for this step.")
        self._screen.step(self._task, more=(text or self._lab.translate(nothing)).split("\n"))

    def _window(self) -> None:
        """Open the window until Ctrl+C: a program of its own, which this one outlives."""
        self._screen.clear()
        with ignoring_interrupts():
            subprocess.run([Path(os.environ[PROGRAMS], "window")], check=False)
        self._screen.step(self._task)
