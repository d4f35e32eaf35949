"""The command that fixes a package."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from grader.base.errors import UsageError
from grader.base.i18n.message import msg, say
from grader.base.i18n.translator import errors_in
from grader.cli import options
from grader.report.notice import notice


@click.command(
    help=msg(
        "Fix the mistakes in your own package that have only one possible fix; shows a diff first."
        "\n\n"
        "PATH is your package or workspace (default: the package in ~/ros2_ws, else the current "
        "folder). Exit status: 0 nothing is wrong any more, 1 something is left that cannot be "
        "fixed automatically (it is named)."
    )
)
@click.argument("path", type=click.Path(path_type=Path), required=False)
@click.option(
    "--dry-run/--apply",
    "dry_run",
    default=True,
    help=msg("Show the fix as a diff (the default), or write it; the old files are kept."),
)
@options.assignment
@options.one_distro
@options.sandbox
@click.option("--check", "only", default="", metavar="ID", help=msg("Fix this check only."))
@click.option(
    "--no-run", is_flag=True, help=msg("Check the files only: build nothing and run nothing.")
)
@options.limits
@options.lang
def fix(
    path: Path | None,
    dry_run: bool,
    assignment: str | None,
    distro: str,
    sandbox: str,
    only: str,
    no_run: bool,
    limits: tuple[str, ...],
    lang: str | None,
) -> int:
    """Fix a student's own package."""
    from grader.cli.fix_package import FixRequest, fix_package  # noqa: PLC0415 - keeps --help fast
    from grader.verdict.order import default_path, make_orders  # noqa: PLC0415

    with errors_in(lang):
        place = path or default_path()
        if path is None and not dry_run and place != Path.home() / "ros2_ws":
            raise UsageError(
                say("no package to fix was named"),
                remedy=say("For example: grader fix --apply path/to/my_package"),
            )
        orders = make_orders(place, assignment, distro, sandbox, limits, own_code=True, lang=lang)
        if len(orders) > 1:
            raise UsageError(say("fix runs the node on one distro: name one"))
        if orders[0].assignment.feedback.lab in ("where", "score"):
            raise UsageError(
                say("there are no fixes for {assignment}", assignment=orders[0].assignment.id),
                remedy=say("Your instructor has chosen that. Ask for help in class."),
            )
        request = FixRequest(order=orders[0], only=only, writes=not dry_run, runs=not no_run)
        return fix_package(request, notify=lambda text: notice(text, sys.stderr))
