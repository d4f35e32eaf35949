"""What `lab watch` shows: the current step, what is found, what is next, and the keys."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Sequence

from rich.cells import cell_len
from rich.text import Text

from grader.base.i18n.message import say
from grader.report.wrap import rows
from lab.guide.opened import OpenedLab
from lab.guide.show import console_for, show_current, show_line, show_list, show_step
from lab.guide.task import Task

KEYS = 4  # lines of the keys below what is shown
BETWEEN = "   "  # two keys of the last line, which is broken only there
PLAIN = "LAB_PLAIN"  # set to anything: nothing is cleared, for screen readers


class Screen:
    """A terminal that shows a lesson."""

    def __init__(self, lab: OpenedLab) -> None:
        self._lab = lab
        self._plain = bool(os.environ.get(PLAIN)) or os.environ.get("TERM", "dumb") == "dumb"

    def clear(self) -> None:
        """Clear the screen, unless it is plain."""
        if not self._plain:
            console_for(sys.stdout).clear()

    def step(
        self, task: Task, *, ahead: int = 0, done: Sequence[int] = (), more: Iterable[str] = ()
    ) -> None:
        """Show the step, the steps that were just `done`, and `more` lines."""
        self.clear()
        console = console_for(sys.stdout)
        lesson, translate = self._lab.lesson, self._lab.translate
        for number in done:
            step = lesson.steps[number - 1]
            text = say("Done: {number}. {title}", number=step.number, title=step.title)
            console.print(Text(translate(text), style="bold green"))
        lines = [*more]
        if ahead:
            show_step(console, lesson.steps[task.position - 1 + ahead], lesson, translate)
        else:
            taken = KEYS + len(done) + sum(rows(line, console.width) for line in lines)
            show_current(console, lesson, task, translate, taken=taken)
        for line in lines:
            show_line(console, line)
        self._keys()

    def steps(self, task: Task) -> None:
        """Show the list of the steps."""
        self.clear()
        console = console_for(sys.stdout)
        show_list(console, self._lab.lesson, task, self._lab.translate)
        self._keys()

    def wait_for_key(self) -> None:
        """Wait for Enter."""
        print(self._lab.translate(say("Press Enter to go on.")), end=" ", flush=True)
        sys.stdin.readline()

    def end(self) -> None:
        """Leave the cursor below what was shown."""
        print()

    def _keys(self) -> None:
        keys = say("n next   h hint   c check   l list   d difference   w window   q quit")
        width, lines = console_for(sys.stdout).width, [""]
        for key in self._lab.translate(keys).split(BETWEEN):
            longer = f"{lines[-1]}{BETWEEN}{key}" if lines[-1] else key
            if cell_len(longer) > width and lines[-1]:
                lines.append(key)
            else:
                lines[-1] = longer
        print("\n" + "\n".join(lines), flush=True)
