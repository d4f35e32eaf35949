"""The command that tests an assignment with its solution, starter and mutants."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from grader.base.errors import UsageError
from grader.cli import options

if TYPE_CHECKING:
    from grader.validate.matrix import Matrix


@click.command()
@click.argument("assignment", metavar="[ASSIGNMENT]", required=False)
@click.option(
    "--static", is_flag=True, help="Only the mutants that the files alone decide; runs nothing."
)
@click.option(
    "--workers", type=click.IntRange(min=1), help="The number of packages to mark at once."
)
@click.option("--only", default="*", metavar="GLOB", help="Only the mutants whose names match.")
@click.option("--named", is_flag=True, help="Only the mutants of mutants.yaml, no automatic ones.")
@click.option(
    "--keep",
    type=click.Path(path_type=Path, file_okay=False),
    help="Also write the mutants to this new folder, to mark one with `grader grade`.",
)
@click.option(
    "--show",
    default="",
    metavar="NAME|all",
    help="Print what a student would read about this mutant, or about each one.",
)
@options.feedback
@click.option(
    "--json",
    "json_file",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Also write the matrix to this file.",
)
@options.keys
@options.one_distro
@options.sandbox
@options.limits
@options.lang
def validate(
    assignment: str | None,
    static: bool,
    workers: int | None,
    only: str,
    named: bool,
    keep: Path | None,
    show: str,
    feedback: str,
    json_file: Path | None,
    keys: Path | None,
    distro: str,
    sandbox: str,
    limits: tuple[str, ...],
    lang: str | None,
) -> int:
    """Test an assignment: mark its solution, starter and mutants, and check the verdicts.

    ASSIGNMENT is its id, or the path of an assignment.yaml (default: the course's only one).

    Exit status: 0 all verdicts are as expected, 1 otherwise.
    """
    from grader.course.find import assignment_file, own_keys  # noqa: PLC0415 - keeps --help fast
    from grader.validate import matrix, validation  # noqa: PLC0415
    from grader.verdict.order import make_orders  # noqa: PLC0415

    if show and static:
        raise click.UsageError("--show builds and runs the mutants: leave out --static")
    if not show and feedback != options.FEEDBACK[0]:
        raise click.UsageError("--feedback is about --show: name a mutant, or all")
    file = assignment_file(assignment)
    order, *others = make_orders(Path(), assignment, distro, sandbox, limits, keys=keys, lang=lang)
    if others:
        raise click.UsageError("validate marks on one distro: name one")
    folder = keys or own_keys(file)
    if folder is None:
        raise UsageError(
            f"no folder is given for the solution of {order.assignment.id}",
            remedy="Give the instructor's folder of the assignment with --keys (make: KEYS=…).",
        )
    wanted = validation.ValidationOptions(
        order=replace(order, tries_fixes=bool(show)),
        keys=folder,
        starter=validation.starter_of(file),
        static=static,
        workers=workers or 0,
        only=only,
        named=named,
        keep=keep,
        show=show,
    )
    found = validation.validate(wanted, notify=lambda text: click.echo(text, err=True))
    if show:
        _print_reports(found, feedback)
    else:
        click.echo(matrix.table(found))
        click.echo()
    click.echo(matrix.summary(found))
    if json_file is not None:
        validation.write_json(found, json_file)
    return 1 if found.faults else 0


def _print_reports(found: Matrix, feedback: str) -> None:
    """Print what a student would read about each mutant."""
    from grader.report import terminal  # noqa: PLC0415 - keeps --help fast
    from grader.validate.shown import as_student_reads, heading  # noqa: PLC0415
    from grader.verdict.checks.all import QUOTES  # noqa: PLC0415

    for row in found.rows:
        click.echo(heading(row))
        click.echo()
        report = as_student_reads(row, feedback)
        if report is not None:
            terminal.print_report(report, quotes=QUOTES)
        click.echo()
