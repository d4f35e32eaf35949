"""`lab notice`: one or two lines if a step is done since the last time; the prompt calls it."""

from __future__ import annotations

import os
import sys

import click

from grader.base.i18n.message import msg, say


@click.command(hidden=True, help=msg("Say which step has just been done, if any."))
def notice() -> None:
    """Compare the current step with the one that the progress has, and keep it."""
    from grader.base.errors import GraderError  # noqa: PLC0415 - keeps --help fast
    from lab.guide.opened import opened_lab  # noqa: PLC0415

    try:
        lab = opened_lab()
        task = lab.task(os.environ)
        kept = lab.progress()
        before = kept.step or 1
        if task.position == before and kept.step:
            return
        lab.keep(step=task.position)
    except (GraderError, OSError):
        return  # a prompt has no place for it; `lab` and `guide` say it
    from rich.text import Text  # noqa: PLC0415

    from lab.guide.show import console_for  # noqa: PLC0415

    console, steps = console_for(sys.stdout), lab.lesson.steps
    for number in range(before, task.position):
        if task.actions[number - 1] is None and steps[number - 1].done:
            step = steps[number - 1]
            text = say("Done: {number}. {title}", number=step.number, title=step.title)
            console.print(Text(lab.translate(text), style="green"))
    is_first = not kept.step and steps[0].optional  # (it does not begin with what the lab gives)
    if (task.position > before or is_first) and task.action is not None:
        now = steps[task.position - 1]
        text = say("Next: {number}. {title} (guide shows it)", number=now.number, title=now.title)
        console.print(Text(lab.translate(text)))
