"""The commands for a class: mark it, and correct a verdict by hand."""

from __future__ import annotations

from pathlib import Path

import click

from grader.base.errors import UsageError
from grader.base.i18n.translator import errors_in
from grader.cli import options

_file = click.Path(path_type=Path, dir_okay=False, exists=True, readable=True)
_ledger = click.option(
    "--ledger",
    type=click.Path(path_type=Path, dir_okay=False),
    help="The file that keeps every verdict (default: ledger.sqlite in the --out folder).",
)


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
    help="The folder that everything is written to (default: reports/<name of the class folder>).",
)
@_ledger
@click.option("--roster", type=_file, help="A CSV of the class: who handed in nothing is shown.")
@click.option(
    "--system",
    default="auto",
    show_default=True,
    help="Where the class comes from: moodle, canvas, gradescope, github_classroom, folders or "
    "archives.",
)
@click.option("--workers", type=click.IntRange(min=1), help="How many are marked at once.")
@click.option("--scheduler", default="", metavar="URL", help="Mark on a Dask cluster: tcp://…")
@click.option("--regrade", is_flag=True, help="Mark everybody again, and show what has changed.")
@click.option(
    "--regrade-student",
    "students",
    multiple=True,
    metavar="STUDENT",
    help="Mark this student again: key, number, name or email. May be repeated.",
)
@click.option("--worksheet", type=_file, help="Moodle's grading worksheet: a filled copy is made.")
@click.option("--canvas", type=_file, help="Canvas' gradebook CSV: a filled copy is made.")
@click.option("--canvas-column", default="", help="The column of Canvas' gradebook that is filled.")
@click.option("--grade-column", default="", help="The worksheet's column of grades.")
@click.option("--feedback-column", default="", help="The worksheet's column of feedback.")
@click.option(
    "--accept",
    "accepts",
    multiple=True,
    metavar="WHAT",
    help="Go on where it stops otherwise: `join`, if less than 80 % of the submissions are on the "
    "roster; `lower`, if somebody gets a lower grade than before. May be repeated.",
)
@click.option("--show-hidden", is_flag=True, help="Name hidden checks in what students read.")
@options.lang
@click.option("-n", "--dry-run", is_flag=True, help="Only say what would be marked.")
@click.option("-q", "--quiet", is_flag=True, help="Do not print a line a student.")
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
    worksheet: Path | None,
    canvas: Path | None,
    canvas_column: str,
    grade_column: str,
    feedback_column: str,
    accepts: tuple[str, ...],
    show_hidden: bool,
    lang: str | None,
    dry_run: bool,
    quiet: bool,
) -> int:
    """Mark a whole class: PATH is what the course's system gave you, a folder or its zip.

    It can be stopped (Ctrl+C) and goes on where it was: what was marked before and has not
    changed is not marked again. What students read is in the language of --lang.
    """
    # a `--help` must not pay for these
    from grader.batch.accept import accepted  # noqa: PLC0415
    from grader.batch.override import LEDGER  # noqa: PLC0415
    from grader.batch.sheets import Sheets  # noqa: PLC0415
    from grader.publish import class_run as run  # noqa: PLC0415
    from grader.verdict.order import make_orders  # noqa: PLC0415

    with errors_in(lang):
        orders = make_orders(path, assignment, distro, sandbox, limits, keys=keys, lang=lang)
    if len(orders) > 1:
        raise UsageError("a class is marked on one distro", remedy="Give --out one for each.")
    out = out or Path("reports") / (path.resolve().stem or "class")
    sheets = Sheets(
        worksheet=worksheet,
        canvas=canvas,
        canvas_column=canvas_column,
        grade_column=grade_column,
        feedback_column=feedback_column,
        show_hidden=show_hidden,
    )
    asked = run.ClassOptions(
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
    return run.grade_all(asked, dry_run=dry_run)


@click.command("override")
@click.argument("student", required=False)
@click.option("--check", "check_id", default="", metavar="ID", help="The check (default: all).")
@click.option("--points", type=float, help="What it is worth for this student.")
@click.option("--because", default="", help="Why; the student reads it.")
@click.option("--remove", is_flag=True, help="Take the correction back.")
@click.option("--list", "list_all", is_flag=True, help="List the corrections that hold.")
@click.option("--force", is_flag=True, help="Also points below 0 or beyond what it is worth.")
@options.assignment
@options.keys
@_ledger
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

    The correction outlives reruns and regrades; the next `grader grade-all` writes it into every
    output. Without --check it corrects the total.
    """
    from grader.batch import override as corrections  # noqa: PLC0415
    from grader.batch.ledger import Ledger  # noqa: PLC0415
    from grader.verdict.order import with_hidden  # noqa: PLC0415

    wanted = with_hidden(assignment, keys)
    place = corrections.find_ledger(ledger, out, Path.cwd())
    with Ledger(place, makes=False) as opened:
        if list_all:
            for line in corrections.listed(opened, wanted):
                click.echo(line)
            return 0
        if student is None or (points is None and not remove):
            raise UsageError(
                "say whose points, and how many",
                remedy="For example: grader override kim --check run.output --points 10 "
                '--because "seen in class"',
            )
        if remove:
            corrections.remove(opened, wanted, student, check_id, say=click.echo)
        else:
            assert points is not None
            corrections.put(
                opened, wanted, student, check_id, points, because, force=force, say=click.echo
            )
    click.echo("Run the same `grader grade-all` again: it writes this into every output.")
    return 0


COMMANDS = (grade_all, override)
