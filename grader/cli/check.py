"""The command that marks a student's own package."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import click

from grader.base.i18n.message import msg, say
from grader.base.i18n.translator import Translator, errors_in
from grader.cli import options

if TYPE_CHECKING:
    from grader.report.model import Report

HINTS = 3  # (`grader.report.detail` imports pydantic, which --help does not need)
NEXT_HINT = "grader check --hints {n}"


@click.command(
    help=msg(
        "Check your own package before you submit it: the same verdict, by the visible checks.\n\n"
        "PATH is your package or workspace (default: the package in ~/ros2_ws, else the current "
        "folder). It is your own code: if no sandbox is available it runs without one, and says so.\n\n"
        "It shows what is wrong and where. --hints 1 adds why it matters, --hints 2 the kind of "
        "change, --hints 3 the line itself, each for the failure to look at first."
    )
)
@click.argument("path", type=click.Path(path_type=Path), required=False)
@options.assignment
@options.distros
@options.sandbox
@options.limits
@options.lang
@click.option(
    "--hints",
    type=click.IntRange(0, HINTS),
    default=0,
    metavar="N",
    help=msg("How many hints to show about the first failure: 0 to 3."),
)
@click.option("--explain", is_flag=True, help=msg("Show everything about each failure at once."))
@click.option("--hint-command", envvar="GRADER_HINT_COMMAND", default=NEXT_HINT, hidden=True)
@options.verbose
def check(
    path: Path | None,
    assignment: str | None,
    distro: str,
    sandbox: str,
    limits: tuple[str, ...],
    lang: str | None,
    hints: int,
    explain: bool,
    hint_command: str,
    verbose: bool,
) -> int:
    """Mark a student's own package, without the hidden checks."""
    asked = Hints(hints, explain, hint_command)
    return check_own(path, assignment, distro, sandbox, limits, lang, verbose=verbose, hints=asked)


@dataclass(frozen=True)
class Hints:
    """How much a student asks to know: hints about the first failure, or everything (`explain`).

    `command` is what shows the next hint; `{n}` in it is the number of hints to ask for.
    """

    number: int = 0
    explain: bool = False
    command: str = NEXT_HINT


def check_own(
    path: Path | None,
    assignment: str | None,
    distro: str,
    sandbox: str,
    limits: tuple[str, ...],
    lang: str | None,
    *,
    verbose: bool = False,
    hints: Hints | None = None,
    heard: Callable[[Report], None] | None = None,
) -> int:
    """Mark a student's own package and return the exit status.

    `heard` gets each report, with everything in it.
    """
    from grader.cli.mark_orders import Asked, mark_orders  # noqa: PLC0415 - keeps --help fast
    from grader.verdict.order import default_path, make_orders  # noqa: PLC0415

    with errors_in(lang):
        place = path or default_path()
        orders = make_orders(place, assignment, distro, sandbox, limits, own_code=True, lang=lang)
        if path is None:
            click.echo(
                Translator(orders[0].lang)(say("checking {path}", path=str(place))), err=True
            )
        given = hints or Hints()
        asked = Asked(given.number, given.explain, given.command)
        return mark_orders(
            orders, None, verbose=verbose, show_hidden=False, asked=asked, heard=heard
        )
