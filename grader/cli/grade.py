"""The command that marks one package."""

from __future__ import annotations

import os
from pathlib import Path

import click

from grader.base.i18n.translator import errors_in
from grader.cli import options


@click.command()
@click.argument("path", type=click.Path(path_type=Path))
@options.assignment
@options.keys
@options.distros
@options.sandbox
@click.option("--name", help="The student's name in the report (default: the folder's).")
@options.limits
@click.option(
    "--out",
    type=click.Path(path_type=Path, file_okay=False),
    default=Path("reports"),
    show_default=True,
    help="The folder for reports.",
)
@click.option(
    "--like",
    type=click.Path(path_type=Path, exists=True),
    metavar="REPORT",
    help="Use the drawn values of this report (report.json or its folder).",
)
@options.lang
@options.whole
@options.verbose
def grade(
    path: Path,
    assignment: str | None,
    keys: Path | None,
    distro: str,
    sandbox: str,
    name: str | None,
    limits: tuple[str, ...],
    out: Path,
    like: Path | None,
    lang: str | None,
    whole: bool,
    verbose: bool,
) -> int:
    """Mark one package: PATH is the package, a workspace, or a repository that holds it."""
    from grader.cli.called import commands_for  # noqa: PLC0415 - keeps --help fast
    from grader.cli.mark_orders import mark_orders  # noqa: PLC0415
    from grader.verdict.order import make_orders  # noqa: PLC0415

    with errors_in(lang):
        orders = make_orders(
            path,
            assignment,
            distro,
            sandbox,
            limits,
            name=name,
            keys=keys,
            lang=lang,
            like=like,
        )
        commands = commands_for("grade", in_lab=False, environment=os.environ)
        return mark_orders(orders, out, commands, whole=whole, verbose=verbose)
