"""`lab status`: the steps, and which are done."""

from __future__ import annotations

import os

import click

from grader.base.i18n.message import msg, say
from grader.base.i18n.translator import errors_in
from grader.cli import options


@click.command(help=msg("List the steps of the lesson and which are done."))
@options.lang
def status(lang: str | None) -> None:
    """Print the list, the next action and the last result of `check`."""
    from lab.guide.opened import opened_lab  # noqa: PLC0415 - keeps --help fast
    from lab.guide.show import show  # noqa: PLC0415

    with errors_in(lang):
        lab = opened_lab(lang)
        task = lab.task(os.environ, look=True)
        kept = lab.progress()
        show("list", lab.lesson, task.actions, lab.translate, passed=kept.passed)
        if kept.checked:
            last = say(
                "Last check: {score} of {most} points.",
                score=f"{kept.score:g}",
                most=f"{kept.max_score:g}",
            )
            click.echo(lab.translate(last))
        if kept.submitted:
            click.echo(lab.translate(say("Archive: {file}", file=kept.submitted)))
