"""Options that several commands share."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import click

from grader.base.i18n.message import msg
from grader.base.nearest import meant, nearest_path


class GivenFile(click.Path):
    """A file that must be there; the message about a misspelt path names the one that is meant."""

    def __init__(self) -> None:
        super().__init__(path_type=Path, dir_okay=False, exists=True, readable=True)

    def convert(
        self,
        value: str | os.PathLike[str],
        param: click.Parameter | None,
        ctx: click.Context | None,
    ) -> Any:
        """Return the path."""
        try:
            return super().convert(value, param, ctx)
        except click.BadParameter as error:
            near = nearest_path(Path(value)) if not os.path.lexists(value) else ""
            text = f"{error.message.removesuffix('.')}{meant(near)}." if near else error.message
            raise click.BadParameter(text, ctx=ctx, param=param) from None


FEEDBACK = ("policy", "full", "hints", "where", "score")
"""`AS_POLICY` and `WORDS` of `grader.report.detail`, which imports pydantic."""
CONTEXT = {"help_option_names": ["-h", "--help"], "max_content_width": 100}
assignment = click.option(
    "--assignment",
    metavar="ID|FILE",
    help=msg(
        "The assignment: its id, or the path of an assignment.yaml (default: the course's only one)."
    ),
)
keys = click.option(
    "--keys",
    type=click.Path(path_type=Path, file_okay=False),
    help="The instructor's folder of the assignment: hidden.yaml, solution, mutants.yaml (default: "
    "the grader's own keys/ID).",
)
sandbox = click.option(
    "--sandbox",
    default="auto",
    show_default=True,
    help=msg("Where the student's code runs: auto, docker, bubblewrap, account or none."),
)
one_distro = click.option(
    "--distro", default="jazzy", show_default=True, help=msg("The ROS 2 distro to mark on.")
)
limits = click.option(
    "--limit",
    "limits",
    multiple=True,
    metavar="NAME=VALUE",
    help=msg(
        "Another value for a limit (seconds, bytes), e.g. build_seconds=120. May be repeated."
    ),
)
distros = click.option(
    "--distro",
    default="jazzy",
    show_default=True,
    help=msg("The ROS 2 distro to mark on; separate several with commas."),
)
lang = click.option(
    "--lang",
    type=click.Choice(["en", "ko"]),
    help=msg("The language of the texts (default: from LC_ALL, LANG and LANGUAGE)."),
)
feedback = click.option(
    "--feedback",
    type=click.Choice(FEEDBACK),
    default=FEEDBACK[0],
    show_default=True,
    help="How much it says about failed checks (default: as the assignment's feedback: says).",
)
whole = click.option(
    "--all",
    "whole",
    is_flag=True,
    help=msg("Show the whole report: every check, and everything about each failure."),
)
verbose = click.option(
    "-v", "--verbose", is_flag=True, help=msg("Show the evidence of every check.")
)
ledger = click.option(
    "--ledger",
    type=click.Path(path_type=Path, dir_okay=False),
    help="The file that stores every verdict (default: ledger.sqlite in the --out folder).",
)
class_out = click.option(
    "--out", type=click.Path(path_type=Path, file_okay=False), help="The class' --out folder."
)
container_sandbox = click.option(
    "--sandbox",
    default="account",
    show_default=True,
    help="Where the student's code runs in Gradescope's container.",
)
