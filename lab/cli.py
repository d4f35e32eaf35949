"""The `lab` command. Exit status: that of the command in the lab (0 after an interactive visit), 2
wrong usage, 3 the lab's own surroundings failed, 130/143 interrupted/terminated.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

import click

import grader
from grader.base.i18n.message import msg
from grader.base.i18n.translator import Translator, chosen_language, errors_in
from grader.cli import options
from grader.cli.invoke import run


def main(argv: list[str] | None = None) -> int:
    """Run the command line and return its exit status."""
    return run(command, "lab", argv)


@click.command(
    context_settings=options.CONTEXT,
    help=msg(
        "Open a ROS 2 terminal with your workspace in it; with a COMMAND, run that there instead.\n\n"
        "The workspace is a folder of this machine and stays when the lab is closed. A second lab "
        "on the same workspace is a second terminal."
    ),
)
@click.version_option(grader.__version__, "-V", "--version", prog_name="lab")
@click.option(
    "--distro", default="jazzy", show_default=True, help=msg("The ROS 2 distro of the lab.")
)
@click.option(
    "--workspace",
    type=click.Path(path_type=Path),
    help=msg(
        "Where the workspace is on this machine; made if it is not there. [default: ~/ros2_ws]"
    ),
)
@click.option(
    "--sandbox",
    default="auto",
    show_default=True,
    help=msg("What the lab is made of: auto, docker or bubblewrap."),
)
@options.assignment
@options.lang
@click.argument("words", nargs=-1, type=click.UNPROCESSED, metavar="[-- COMMAND...]")
def command(
    distro: str,
    workspace: Path | None,
    sandbox: str,
    assignment: str | None,
    lang: str | None,
    words: tuple[str, ...],
) -> int:
    """Open the lab on this terminal."""
    from grader.ros.distro import find_distro  # noqa: PLC0415 - --help must not pay for it
    from lab.choose import choose  # noqa: PLC0415
    from lab.lesson import lesson_meant  # noqa: PLC0415
    from lab.visit import Visit  # noqa: PLC0415
    from lab.workspace import prepare  # noqa: PLC0415

    translate = Translator(lang or chosen_language(os.environ))
    with errors_in(translate.lang):
        found = find_distro(distro)
        lesson = lesson_meant(assignment)
        enter = choose(sandbox, found, notify=lambda text: _tell(translate(text)))
        visit = Visit(found, prepare(workspace), lesson, command=words, lang=translate.lang)
        status = enter(visit)
    interactive = not words and sys.stdin.isatty()
    return 0 if interactive else status  # what a shell's last command said is no fault of the lab


def _tell(text: str) -> None:
    click.echo(f"lab: {text}", err=True)
