"""The command that corrects verdicts by hand, and writes comments to students."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import click

from grader.base.errors import UsageError
from grader.cli import options

if TYPE_CHECKING:
    from grader.batch.corrections_file import Correction
    from grader.batch.ledger import Ledger
    from grader.course.assignment import Assignment

EXAMPLE = (
    'For example: grader override kim --check run.output --points 10 --because "seen in class"'
)


@dataclass(frozen=True)
class _Wanted:
    """What the command was asked to do."""

    student: str | None
    check: str
    points: float | None
    because: str
    comment: str | None
    file: Path | None
    mistake: str
    force: bool


@click.command("override")
@click.argument("student", required=False)
@click.option("--check", "check_id", default="", metavar="ID", help="The check (default: all).")
@click.option("--points", type=float, help="The points for this student.")
@click.option("--because", default="", help="The reason; the student reads it.")
@click.option("--comment", help="What the student reads besides; an empty text takes it back.")
@click.option(
    "--from",
    "file",
    type=options.GivenFile(),
    help="A CSV file with the columns student, check, points, because, comment: by-hand.csv of the "
    "output folder, filled in, or your own.",
)
@click.option(
    "--mistake", default="", metavar="ID", help="All students whose verdict has this mistake."
)
@click.option("-n", "--dry-run", is_flag=True, help="Only show what would be recorded.")
@click.option("--remove", is_flag=True, help="Remove the correction.")
@click.option("--list", "list_all", is_flag=True, help="List the corrections.")
@click.option("--force", is_flag=True, help="Allow points below 0 or above the maximum.")
@options.assignment
@options.keys
@options.ledger
@options.class_out
def override(
    student: str | None,
    check_id: str,
    points: float | None,
    because: str,
    comment: str | None,
    file: Path | None,
    mistake: str,
    dry_run: bool,
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

    --from FILE records many at once, --mistake ID corrects all students with the same mistake.
    """
    from grader.batch import override as corrections  # noqa: PLC0415 - keeps --help fast
    from grader.batch.ledger import Ledger  # noqa: PLC0415
    from grader.verdict.order import load_with_hidden  # noqa: PLC0415

    wanted = load_with_hidden(assignment, keys)
    asked = _Wanted(student, check_id, points, because, comment, file, mistake, force)
    place = corrections.find_ledger(ledger, out, Path.cwd())
    with Ledger(place, makes=False) as opened:
        if list_all:
            for line in corrections.listed(opened, wanted):
                click.echo(line)
            return 0
        if remove:
            if student is None:
                raise UsageError("STUDENT is required with --remove")
            corrections.remove(opened, wanted, student, check_id, notify=click.echo)
        elif comment is not None and not comment.strip() and student is not None:
            corrections.drop_comment(opened, wanted, student, notify=click.echo)
        else:
            rows = _rows(asked, opened, wanted)
            for row in rows:
                click.echo(row.text)
            if dry_run:
                click.echo(f"{len(rows)} would be recorded; nothing was")
                return 0
            count = corrections.record(opened, wanted, rows)
            same = len(rows) - count
            if len(rows) > 1 or same > 0:
                before = f", {same} of these were recorded before" if same > 0 else ""
                click.echo(f"{count} recorded{before}")
    click.echo("Run the same `grader grade-all` again: it writes this into every output.")
    return 0


def _rows(asked: _Wanted, ledger: Ledger, assignment: Assignment) -> list[Correction]:
    """Return what is to be recorded; raise UsageError if it is not clear or not possible."""
    from grader.batch.corrections_file import Correction, check_points, read_corrections  # noqa: PLC0415 - keeps --help fast
    from grader.batch.find_student import find_student  # noqa: PLC0415
    from grader.batch.mistake_group import check_of, mistake_group  # noqa: PLC0415

    ways = [asked.student is not None, asked.file is not None, bool(asked.mistake)]
    if sum(ways) > 1:
        raise UsageError("give one of STUDENT, --from and --mistake")
    class_ = ledger.students(assignment.id)
    if asked.file is not None:
        rows, notes = read_corrections(asked.file, class_, assignment, force=asked.force)
        for note in notes:
            click.echo(note, err=True)
        return rows
    comment = (asked.comment or "").strip()
    if not any(ways) or (asked.points is None and not comment):
        raise UsageError("STUDENT and --comment or --points are required", remedy=EXAMPLE)
    check = asked.check
    if asked.mistake:
        group = mistake_group(ledger, assignment.id, asked.mistake)
        students = list(group.students)
        check = check_of(group, check) if asked.points is not None else check
    else:
        students = [find_student(asked.student or "", class_)]
    if asked.points is not None:
        check_points(assignment, check, asked.points, force=asked.force)
        if not asked.because.strip():
            raise UsageError("a reason is needed: --because TEXT", remedy="The student reads it.")
    because = asked.because.strip()
    return [Correction(one, check, asked.points, because, comment) for one in students]
