"""`lab hint`: says more about the current task, each time it is called, up to the line itself."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import click

from grader.base.i18n.message import msg, say
from grader.base.i18n.translator import errors_in
from grader.cli import options
from lab.guide.hints import hints_of
from lab.guide.opened import WORKSPACE, OpenedLab
from lab.guide.task import Task


@click.command(
    help=msg(
        "Say more about the current step. Each call says more: first why, then where or what kind of "
        "change, then the line or the command itself. Hints cost no points; they are counted only in "
        "your own workspace."
    )
)
@options.lang
def hint(lang: str | None) -> None:
    """Print the hints so far and the next one, and count it."""
    from lab.guide.opened import opened_lab  # noqa: PLC0415 - keeps --help fast
    from lab.guide.show import console_for, show_line, show_next  # noqa: PLC0415

    with errors_in(lang):
        lab = opened_lab(lang)
        console = console_for(sys.stdout)
        task = lab.task(os.environ, look=True)
        show_next(console, task, lab.translate, more=False)
        for line in next_hint(lab, task):
            show_line(console, line)


def next_hint(lab: OpenedLab, task: Task) -> list[str]:
    """Return the lines of one more hint and those before it, and count it in the progress."""
    if task.action is None:
        return []
    translate = lab.translate
    package = Path(WORKSPACE, "src", lab.assignment.package)
    hints = hints_of(task.action, lab.lesson.steps[task.position - 1], package)
    used = min(lab.progress().hints.get(task.action.id, 0) + 1, len(hints))
    lines: list[str] = []
    lab.keep(hints={**lab.progress().hints, task.action.id: used})
    for number, text in enumerate(hints[:used], start=1):
        label = say("Hint {number} of {count}: ", number=number, count=len(hints))
        lines += (translate(label) + translate(text)).rstrip().split("\n")
    return lines
