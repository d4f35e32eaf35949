"""The `guide` command: prints the current step, another step, a list, or the whole lesson."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

import click

from grader.base.i18n.message import msg
from grader.base.i18n.translator import errors_in
from grader.cli import options
from grader.cli.invoke import run


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status."""
    return run(command, "guide", list(argv or ()))


@click.command(
    context_settings={"help_option_names": ["-h", "--help"]},
    help=msg(
        "Show what to do next. N shows step N, `list` all steps and which are done, `all` the whole "
        "lesson.\n\n"
        "A step is recognised as done by the files in your workspace and by this terminal."
    ),
)
@click.option(
    "--workspace",
    type=click.Path(path_type=Path),
    default=Path("~/ros2_ws"),
    show_default=True,
    help=msg("The folder of the workspace."),
)
@options.assignment
@options.lang
@click.argument("what", required=False, metavar="[N|list|all]")
def command(workspace: Path, assignment: str | None, lang: str | None, what: str | None) -> None:
    """Print a step of the lesson."""
    from lab.guide.opened import opened_lab  # noqa: PLC0415 - keeps --help fast
    from lab.guide.show import show  # noqa: PLC0415

    with errors_in(lang):
        lab = opened_lab(lang, workspace, assignment)
        show(
            what,
            lab.lesson,
            lab.task(os.environ, look=what is None or what == "list"),
            lab.translate,
        )
