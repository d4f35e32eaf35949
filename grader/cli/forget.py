"""The command that removes all that is kept about students."""

from __future__ import annotations

import sys
from datetime import datetime, timezone
from pathlib import Path
from typing import TYPE_CHECKING

import click

from grader.base.errors import UsageError
from grader.cli import options

if TYPE_CHECKING:
    from grader.batch.forget import Forgotten
    from grader.batch.ledger import Ledger
    from grader.batch.model import Student

MOST_SHOWN = 10


@click.command("forget")
@click.argument("student", required=False)
@click.option(
    "--before",
    metavar="DATE",
    help="All students who handed in nothing since that day (2026-03-01), instead of STUDENT.",
)
@click.option("-n", "--dry-run", is_flag=True, help="Only show what would be removed.")
@click.option("--yes", is_flag=True, help="Do not ask.")
@options.ledger
@options.class_out
def forget(
    student: str | None,
    before: str | None,
    dry_run: bool,
    yes: bool,
    ledger: Path | None,
    out: Path | None,
) -> int:
    """Remove all that is kept about a student: verdicts, evidence, corrections, reports, feedback.

    The ledger's chain stays whole: it says that rows were removed, and keeps nothing of them. Remove
    the submission from the download and the roster yourself, or the next run marks it again.
    Nothing can be brought back; see what goes with --dry-run.
    """
    from grader.batch import forget as removal  # noqa: PLC0415 - keeps --help fast
    from grader.batch.ledger import Ledger  # noqa: PLC0415
    from grader.batch.override import find_ledger  # noqa: PLC0415

    if (student is None) == (before is None):
        raise UsageError("give STUDENT or --before DATE")
    place = find_ledger(ledger, out, Path.cwd())
    folder = out or place.parent
    with Ledger(place, makes=False) as opened:
        students = _students(opened, student, before)
        found = [
            removal.kept_about(opened, folder, one, removal.report_folders(opened, one))
            for one in students
        ]
        _show(found)
        if dry_run or not found:
            click.echo("nothing was removed")
            return 0
        if not (yes or _agreed(len(found))):
            raise UsageError("nothing was removed", remedy="To remove it without a question: --yes")
        removal.forget(opened, folder, found)
        head = opened.check_chain(None).head
    click.echo(f"removed; the ledger's head is now {head.hash}")
    click.echo(
        "Remove the submission from the download and the roster, then run `grader grade-all`."
    )
    return 0


def _students(ledger: Ledger, word: str | None, before: str | None) -> list[Student]:
    from grader.batch.find_student import find_student  # noqa: PLC0415 - keeps --help fast
    from grader.batch.forget import last_seen_before  # noqa: PLC0415

    if before is not None:
        try:
            day = datetime.strptime(before, "%Y-%m-%d").replace(tzinfo=timezone.utc)
        except ValueError:
            raise UsageError(f"'{before}' is not a day such as 2026-03-01 (--before)") from None
        return last_seen_before(ledger, day)
    all_ = {one.key: one for name in ledger.assignments() for one in ledger.students(name)}
    return [find_student(word or "", list(all_.values()))]


def _show(found: list[Forgotten]) -> None:
    for one in found[:MOST_SHOWN]:
        rows = ", ".join(f"{count} {table}" for table, count in one.rows.items()) or "none"
        click.echo(f"{one.student.name or one.student.key}: rows of the ledger: {rows}")
        for place in one.files:
            click.echo(f"  {place}")
        for text in one.by_hand:
            click.echo(f"  yourself: {text}")
    if found[MOST_SHOWN:]:
        click.echo(f"and {len(found) - MOST_SHOWN} more students")


def _agreed(count: int) -> bool:
    if not sys.stdin.isatty():
        return False
    who = "this student" if count == 1 else f"these {count} students"
    return click.confirm(f"Remove all of {who} for good?", default=False)
