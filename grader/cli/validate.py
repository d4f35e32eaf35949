"""The command that marks an assignment's own solution, starter and mutants."""

from __future__ import annotations

from pathlib import Path

import click

from grader.base.errors import UsageError
from grader.cli import options


@click.command()
@click.argument("assignment", metavar="[ASSIGNMENT]", required=False)
@click.option("--static", is_flag=True, help="Only the mutants whose files decide them: no run.")
@click.option("--workers", type=click.IntRange(min=1), help="How many are marked at once.")
@click.option("--only", default="*", metavar="GLOB", help="Only the mutants with such a name.")
@click.option(
    "--json",
    "json_file",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Write the matrix to this file as well.",
)
@options.keys
@options.one_distro
@options.sandbox
@options.limits
def validate(
    assignment: str | None,
    static: bool,
    workers: int | None,
    only: str,
    json_file: Path | None,
    keys: Path | None,
    distro: str,
    sandbox: str,
    limits: tuple[str, ...],
) -> int:
    """Mark an assignment's own solution, starter and mutants: does it mark what it claims to?

    ASSIGNMENT is its id, or the path of an assignment.yaml (default: the course's only one).

    Exit status: 0 everything is as expected, 1 something is not.
    """
    from grader.course.find import assignment_file, own_keys  # noqa: PLC0415
    from grader.validate import matrix  # noqa: PLC0415
    from grader.validate import validation as command  # noqa: PLC0415
    from grader.verdict.order import make_orders  # noqa: PLC0415

    file = assignment_file(assignment)
    order, *others = make_orders(Path(), assignment, distro, sandbox, limits, keys=keys, lang="en")
    if others:
        raise click.UsageError("validate marks on one distro: name one")
    folder = keys or own_keys(file)
    if folder is None:
        raise UsageError(
            f"it is not said where the solution of {order.assignment.id} is",
            remedy="Name the instructor's folder of the assignment with --keys (make: KEYS=…).",
        )
    options = command.ValidationOptions(
        order=order,
        keys=folder,
        starter=command.starter_of(file),
        static=static,
        workers=workers or 0,
        only=only,
    )
    found = command.validate(options, say=lambda text: click.echo(text, err=True))
    click.echo(matrix.table(found))
    click.echo()
    click.echo(matrix.summary(found))
    if json_file is not None:
        command.write_json(found, json_file)
    return 1 if found.faults else 0


COMMANDS = (validate,)
