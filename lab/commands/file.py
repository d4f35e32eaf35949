"""`lab file`: the path of the file that the lesson is about, for other commands of the lab."""

from __future__ import annotations

import click

from grader.base.i18n.message import msg


@click.command(hidden=True, help=msg("Print the path of the node's file."))
def file() -> None:
    """Print it as a student types it."""
    from lab.guide.opened import opened_lab  # noqa: PLC0415 - keeps --help fast

    lesson = opened_lab().assignment
    click.echo(f"~/ros2_ws/src/{lesson.package}/{lesson.package}/{lesson.node_file}")
