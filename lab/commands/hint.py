"""`lab hint`: says more about the current task, each time it is called, up to the line itself."""

from __future__ import annotations

import os
import re
import sys

import click

from grader.base.i18n.message import msg, say
from grader.base.i18n.translator import errors_in
from grader.cli import options
from lab.guide.opened import OpenedLab, Task

STUCK = re.compile(r"^\*[^*\n]{1,40}\?\* +(.+?)(?:\n\n|\Z)", re.MULTILINE | re.DOTALL)
"""The paragraph of a step that begins with a question in italics (*Stuck?*)."""


@click.command(
    help=msg(
        "Say more about the current step. Each call says more: first why, then what kind of change, "
        "then the line itself. Hints cost no points; they are counted only in your own workspace."
    )
)
@options.lang
def hint(lang: str | None) -> None:
    """Print the hints so far and the next one, and count it."""
    from lab.guide.opened import opened_lab  # noqa: PLC0415 - keeps --help fast
    from lab.guide.show import console_for, show_line  # noqa: PLC0415

    with errors_in(lang):
        lab = opened_lab(lang)
        console = console_for(sys.stdout)
        for line in next_hint(lab, lab.task(os.environ, look=True)):
            show_line(console, line)


def next_hint(lab: OpenedLab, task: Task) -> list[str]:
    """Return the lines to show for one more hint, and count it in the student's progress."""
    translate = lab.translate
    if task.action is None:
        return [translate(say("All steps of this lesson are done."))]
    hints = hints_of(lab, task)
    used = min(lab.progress().hints.get(task.action.id, 0) + 1, max(len(hints), 1))
    lines = [translate(task.action.found)] if task.action.found else []
    lines.append(translate(task.action.next))
    if not hints:
        return [*lines, translate(say("There is no hint for this. The step's text: guide"))]
    lab.keep(hints={**lab.progress().hints, task.action.id: used})
    for number, text in enumerate(hints[:used], start=1):
        label = say("Hint {number} of {count}: ", number=number, count=len(hints))
        lines.append(translate(label) + _indented(translate(text)))
    return lines


def hints_of(lab: OpenedLab, task: Task) -> tuple[str, ...]:
    """Return the hints of a task: its own, else the step's paragraph for those who are stuck."""
    if task.action is None or task.action.hints:
        return task.action.hints if task.action is not None else ()
    return tuple(
        " ".join(text.split()) for text in STUCK.findall(lab.lesson.steps[task.position - 1].text)
    )


def _indented(text: str) -> str:
    first, *rest = text.split("\n")
    return "\n".join([first, *(f"    {line}" for line in rest)]) if rest else first
