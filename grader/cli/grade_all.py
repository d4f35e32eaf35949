"""The command that marks a class."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import click

from grader.base.errors import UsageError
from grader.base.i18n.translator import errors_in
from grader.batch.accept import accepted
from grader.batch.override import LEDGER
from grader.batch.sheets import SheetOptions
from grader.batch.systems.known import DOWNLOADS, sheet_forms
from grader.cli import options

_file = options.GivenFile()


def _sheets(command: Callable[..., int]) -> Callable[..., int]:
    """Add the options of the systems' files: `--worksheet FILE`, `--grade-column NAME` and so on."""
    for form in reversed(sheet_forms()):
        for name, text in reversed(list(form.columns.items())):
            option = f"--{name.replace('_', '-')}"
            command = click.option(option, default="", metavar="NAME", help=text)(command)
        command = click.option(f"--{form.option}", type=_file, help=form.help)(command)
    return command


@click.command("grade-all")
@click.argument("path", type=click.Path(path_type=Path))
@options.assignment
@options.keys
@options.one_distro
@options.sandbox
@options.limits
@click.option(
    "--out",
    type=click.Path(path_type=Path, file_okay=False),
    help="The folder for all output (default: reports/<name of the class folder>).",
)
@options.ledger
@click.option(
    "--roster", type=_file, help="A CSV of the class; shows students without a submission."
)
@click.option(
    "--system",
    default="auto",
    show_default=True,
    help=f"Where the class comes from: {', '.join(DOWNLOADS)}.",
)
@click.option(
    "--workers", type=click.IntRange(min=1), help="The number of submissions to mark at once."
)
@click.option("--scheduler", default="", metavar="URL", help="Mark on a Dask cluster: tcp://…")
@click.option("--regrade", is_flag=True, help="Mark all students again and show what has changed.")
@click.option(
    "--regrade-student",
    "students",
    multiple=True,
    metavar="STUDENT",
    help="Mark this student again: key, number, name or email. May be repeated.",
)
@_sheets
@click.option(
    "--accept",
    "accepts",
    multiple=True,
    metavar="WHAT",
    help="Continue where the command would stop: `join`, if less than 80 % of the submissions are "
    "on the roster; `lower`, if a student gets a lower grade than before. May be repeated.",
)
@click.option("--show-hidden", is_flag=True, help="Name hidden checks in the texts for students.")
@options.lang
@click.option("-n", "--dry-run", is_flag=True, help="Only show what would be marked.")
@click.option("-q", "--quiet", is_flag=True, help="Do not print a line for each student.")
def grade_all(
    path: Path,
    assignment: str | None,
    keys: Path | None,
    distro: str,
    sandbox: str,
    limits: tuple[str, ...],
    out: Path | None,
    ledger: Path | None,
    roster: Path | None,
    system: str,
    workers: int | None,
    scheduler: str,
    regrade: bool,
    students: tuple[str, ...],
    accepts: tuple[str, ...],
    show_hidden: bool,
    lang: str | None,
    dry_run: bool,
    quiet: bool,
    **of_sheets: Path | str | None,
) -> int:
    """Mark a class: PATH is the download of the learning management system, a folder or a zip.

    Stop it with Ctrl+C and run it again to continue: submissions that are already marked and
    have not changed are not marked again. The texts for students are in the language of --lang.
    """
    from grader.publish import class_run  # noqa: PLC0415
    from grader.verdict.order import make_orders  # noqa: PLC0415

    with errors_in(lang):
        orders = make_orders(path, assignment, distro, sandbox, limits, keys=keys, lang=lang)
    if len(orders) > 1:
        raise UsageError(
            "a class is marked on one distro",
            remedy="Run the command once for each, with its own --out.",
        )
    out = out or Path("reports") / (path.resolve().stem or "class")
    sheets = SheetOptions(
        files={name: value for name, value in of_sheets.items() if isinstance(value, Path)},
        columns={name: value for name, value in of_sheets.items() if isinstance(value, str)},
        show_hidden=show_hidden,
    )
    class_options = class_run.ClassOptions(
        order=orders[0],
        out=out,
        ledger=ledger or out / LEDGER,
        system=system,
        roster=roster,
        regrade=regrade,
        students=students,
        workers=workers or 0,
        scheduler=scheduler,
        sheets=sheets,
        accepts=accepted(accepts),
        quiet=quiet,
    )
    return class_run.grade_all(class_options, dry_run=dry_run)
