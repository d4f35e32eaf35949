"""`lab status`: the steps, and which are done."""

from __future__ import annotations

import os
import sys

import click

from grader.base.i18n.message import msg, say
from grader.base.i18n.translator import errors_in
from grader.cli import options


@click.command(help=msg("List the steps of the lesson and which are done."))
@options.lang
def status(lang: str | None) -> None:
    """Print the list, the next action and the last result of `check`."""
    from grader.report.notice import notice  # noqa: PLC0415 - keeps --help fast
    from lab.guide.opened import opened_lab  # noqa: PLC0415
    from lab.guide.progress import submitted  # noqa: PLC0415
    from lab.guide.show import show  # noqa: PLC0415

    with errors_in(lang):
        lab = opened_lab(lang)
        task = lab.task(os.environ, look=True)
        kept = lab.progress()
        show("list", lab.lesson, task, lab.translate)
        if kept.checked:
            points = {"score": f"{kept.score:g}", "most": f"{kept.max_score:g}"}
            last = say("Last check: {score} of {most} points.", **points)
            if not task.is_checked:
                last = say(
                    "Last check: {score} of {most} points, before your last change.", **points
                )
            notice(lab.translate(last), sys.stdout)
        if kept.submitted:
            file, made = submitted(kept)
            archive = say("Archive: {file}", file=f"~/ros2_ws/{file}")
            if made is not None:
                archive = say(
                    "Archive: {file}, made on {day} at {time}",
                    file=f"~/ros2_ws/{file}",
                    day=f"{made:%Y-%m-%d}",
                    time=f"{made:%H:%M}",
                )
            click.echo(lab.translate(archive))
