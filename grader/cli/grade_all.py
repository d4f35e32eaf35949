"""The command that marks a class."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from grader.base.errors import UsageError
from grader.base.i18n.translator import errors_in
from grader.batch.accept import accepted
from grader.batch.given_files import EXTENSIONS, JOIN, KINDS, TIMES
from grader.batch.override import LEDGER
from grader.batch.sheets import SheetOptions
from grader.batch.systems.known import DOWNLOADS, sheet_forms
from grader.cli import options

if TYPE_CHECKING:
    from grader.batch.course_file import CourseLesson

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
    "--join",
    type=_file,
    help="A corrected join.csv (every run writes one): which file is whose.",
)
@click.option(
    "--extensions",
    type=_file,
    help="A CSV of students or sections with a new due date, days or slip days.",
)
@click.option(
    "--times",
    type=_file,
    help="A CSV of students or files with the time of submission, if the system does not say it.",
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
@click.option(
    "--regrade-mistake",
    "mistakes",
    multiple=True,
    metavar="ID",
    help="Mark all students again whose verdict has this mistake. May be repeated.",
)
@click.option(
    "--course",
    "course",
    type=_file,
    help="The file of a course (YAML): its lessons with due dates, weights and files. PATH then has "
    "one folder or archive for each lesson, and there is one gradebook of all.",
)
@click.option(
    "--pseudonyms",
    is_flag=True,
    help="Also write a gradebook without names, addresses, numbers, times and texts, to show to others.",
)
@click.option("--xlsx", is_flag=True, help="Also write the course's gradebook as .xlsx.")
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
@click.option(
    "-n",
    "--dry-run",
    is_flag=True,
    help="Only show which file is whose, and what would be marked and changed.",
)
@click.option("--yes", is_flag=True, help="Do not ask before a run of more than a minute.")
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
    join: Path | None,
    extensions: Path | None,
    times: Path | None,
    system: str,
    workers: int | None,
    scheduler: str,
    regrade: bool,
    students: tuple[str, ...],
    mistakes: tuple[str, ...],
    course: Path | None,
    pseudonyms: bool,
    xlsx: bool,
    accepts: tuple[str, ...],
    show_hidden: bool,
    lang: str | None,
    dry_run: bool,
    yes: bool,
    quiet: bool,
    **of_sheets: Path | str | None,
) -> int:
    """Mark a class: PATH is the download of the learning management system, a folder or a zip.

    Stop it with Ctrl+C and run it again to continue: submissions that are already marked and
    have not changed are not marked again. The texts for students are in the language of --lang.
    """
    from grader.publish import class_run  # noqa: PLC0415 - keeps --help fast
    from grader.verdict.order import make_orders  # noqa: PLC0415

    def options_of(
        path: Path, named: str | None, out: Path, files: Mapping[str, Path | None]
    ) -> class_run.ClassOptions:
        with errors_in(lang):
            orders = make_orders(path, named, distro, sandbox, limits, keys=keys, lang=lang)
        if len(orders) > 1:
            raise UsageError(
                "a class is marked on one distro",
                remedy="Run the command once for each, with its own --out.",
            )
        sheets = SheetOptions(
            files={form.option: file for form in sheet_forms() if (file := files.get(form.option))},
            columns={name: value for name, value in of_sheets.items() if isinstance(value, str)},
            show_hidden=show_hidden,
        )
        return class_run.ClassOptions(
            order=orders[0],
            out=out,
            ledger=ledger or out / LEDGER,
            system=system,
            roster=files.get("roster"),
            regrade=regrade,
            students=students,
            mistakes=mistakes,
            workers=workers or 0,
            scheduler=scheduler,
            sheets=sheets,
            accepts=accepted(accepts),
            given={name: files.get(name) for name in KINDS},
            yes=yes,
            quiet=quiet,
            pseudonyms=pseudonyms,
        )

    given = {JOIN: join, EXTENSIONS: extensions, TIMES: times}
    own = {"roster": roster, **given, **{n: v for n, v in of_sheets.items() if isinstance(v, Path)}}
    if course is None:
        if xlsx:
            raise UsageError("--xlsx is for the gradebook of a course (--course)")
        place = out or Path("reports") / (path.resolve().stem or "class")
        return class_run.grade_all(options_of(path, assignment, place, own), dry_run=dry_run)
    from grader.publish.course_run import grade_course  # noqa: PLC0415

    elsewhere = {"assignment": assignment, "keys": keys, "ledger": ledger, **own}
    if named := [f"--{name}" for name, value in elsewhere.items() if value]:
        raise UsageError(f"with --course, {', '.join(named)} cannot be given: name it in {course}")

    def of_lesson(lesson: CourseLesson, path: Path, out: Path) -> class_run.ClassOptions:
        made = options_of(path, lesson.assignment, out, lesson.files)
        return replace(made, order=replace(made.order, assignment=lesson.of(made.order.assignment)))

    def notify(text: str) -> None:
        click.echo(text, err=True)

    place = out or Path("reports") / course.stem
    return grade_course(course, path, place, of_lesson, dry_run=dry_run, xlsx=xlsx, notify=notify)
