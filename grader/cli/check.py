"""The command that marks a student's own package."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import click

from grader.base.i18n.message import msg, say
from grader.base.i18n.translator import Translator, errors_in
from grader.cli import options
from grader.report.notice import notice

if TYPE_CHECKING:
    from grader.report.model import Report
    from grader.report.one_screen import State

HINTS = 3  # (`grader.report.detail` imports pydantic, which --help does not need)


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
@options.whole
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
    whole: bool,
    verbose: bool,
) -> int:
    """Mark a student's own package, without the hidden checks."""
    asked = Hints(hints, explain)
    return check_own(
        path, assignment, distro, sandbox, limits, lang, whole=whole, verbose=verbose, hints=asked
    )


@dataclass(frozen=True)
class Hints:
    """How much a student asks to know: hints about the first failure, or everything (`explain`).

    `command` is the lab's command for the next hint, "" outside of the lab.
    """

    number: int = 0
    explain: bool = False
    command: str = ""


def check_own(
    path: Path | None,
    assignment: str | None,
    distro: str,
    sandbox: str,
    limits: tuple[str, ...],
    lang: str | None,
    *,
    whole: bool = False,
    verbose: bool = False,
    hints: Hints | None = None,
    heard: Callable[[Report], State | None] | None = None,
) -> int:
    """Mark a student's own package and return the exit status.

    `whole` shows more than a screen. `heard` gets each report, with everything in it, and may return
    what a student has to do first.
    """
    from grader.cli.called import commands_for  # noqa: PLC0415 - keeps --help fast
    from grader.cli.mark_orders import Asked, mark_orders  # noqa: PLC0415 - keeps --help fast
    from grader.verdict.order import default_path, make_orders  # noqa: PLC0415

    with errors_in(lang):
        place = path or default_path()
        orders = make_orders(place, assignment, distro, sandbox, limits, own_code=True, lang=lang)
        if path is None:
            translate = Translator(orders[0].lang)
            notice(translate(say("checking {path}", path=str(place))), sys.stderr)
        given = hints or Hints()
        commands = commands_for("check", in_lab=bool(given.command), environment=os.environ)
        return mark_orders(
            orders,
            None,
            commands,
            whole=whole or given.explain,
            verbose=verbose,
            asked=Asked(given.number, given.explain),
            heard=heard,
        )
