"""The command that corrects a verdict by hand."""

from __future__ import annotations

from pathlib import Path

import click

from grader.base.errors import UsageError
from grader.cli import options


@click.command("override")
@click.argument("student", required=False)
@click.option("--check", "check_id", default="", metavar="ID", help="The check (default: all).")
@click.option("--points", type=float, help="The points for this student.")
@click.option("--because", default="", help="The reason; the student reads it.")
@click.option("--remove", is_flag=True, help="Remove the correction.")
@click.option("--list", "list_all", is_flag=True, help="List the corrections.")
@click.option("--force", is_flag=True, help="Allow points below 0 or above the maximum.")
@options.assignment
@options.keys
@options.ledger
@click.option(
    "--out", type=click.Path(path_type=Path, file_okay=False), help="The class' --out folder."
)
def override(
    student: str | None,
    check_id: str,
    points: float | None,
    because: str,
    remove: bool,
    list_all: bool,
    force: bool,
    assignment: str | None,
    keys: Path | None,
    ledger: Path | None,
    out: Path | None,
) -> int:
    """Correct a verdict by hand: grader override STUDENT --check ID --points N --because WHY.

    The correction belongs to the verdict that counts now: it stays if the same files are marked
    again, and is listed for you if the student hands in again. The next `grader grade-all` writes it
    into every output. Without --check it corrects the total.
    """
    from grader.batch import override as corrections  # noqa: PLC0415 - keeps --help fast
    from grader.batch.ledger import Ledger  # noqa: PLC0415
    from grader.verdict.order import load_with_hidden  # noqa: PLC0415

    wanted = load_with_hidden(assignment, keys)
    place = corrections.find_ledger(ledger, out, Path.cwd())
    with Ledger(place, makes=False) as opened:
        if list_all:
            for line in corrections.listed(opened, wanted):
                click.echo(line)
            return 0
        if student is None or (points is None and not remove):
            raise UsageError(
                "STUDENT and --points are required",
                remedy="For example: grader override kim --check run.output --points 10 "
                '--because "seen in class"',
            )
        if remove:
            corrections.remove(opened, wanted, student, check_id, notify=click.echo)
        else:
            assert points is not None
            corrections.put(
                opened, wanted, student, check_id, points, because, force=force, notify=click.echo
            )
    click.echo("Run the same `grader grade-all` again: it writes this into every output.")
    return 0
