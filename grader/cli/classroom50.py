"""The commands for Classroom 50: its autograder.py, and its scores beside your own."""

from __future__ import annotations

from pathlib import Path

import click

from grader.base.errors import UsageError
from grader.base.nearest import meant, nearest
from grader.base.shown import shown
from grader.batch.systems.classroom50 import autograder as script
from grader.batch.systems.classroom50.compare import compared, report_lines
from grader.cli import options
from grader.cli.options import GivenFile
from grader.course.folder import course_folder
from grader.ros.distro import find_distro


@click.command("classroom50-autograder")
@click.argument("assignment", metavar="ID")
@options.one_distro
def autograder(assignment: str, distro: str) -> int:
    """Print the autograder.py for an assignment in Classroom 50.

    ID is the lesson's. Save the file as CLASSROOM/autograders/SLUG/autograder.py in your config repository, and
    let the assignment's runtime name the image of the lab: docs/classes.md.
    """
    text = Path(script.__file__).read_text(encoding="utf-8")
    place = f'ASSIGNMENT, DISTRO = "{script.ASSIGNMENT}", "{script.DISTRO}"'
    known = [file.parent.name for file in sorted(course_folder().glob("*/assignment.yaml"))]
    if (known and assignment not in known) or not assignment.isidentifier():
        close = nearest(assignment, known) or ""
        raise UsageError(
            f"the course has no lesson '{shown(assignment)}'{meant(close)}",
            remedy=f"Lessons: {', '.join(known)}.",
        )
    chosen = f'ASSIGNMENT, DISTRO = "{assignment}", "{find_distro(distro).name}"'
    click.echo(text.replace(place, chosen, 1), nl=False)
    return 0


@click.command("classroom50-compare")
@click.argument("scores", type=GivenFile())
@click.argument("gradebook", type=GivenFile())
@click.option("--slug", default="", help="The assignment in scores.json (default: the only one).")
@click.option(
    "--clones",
    type=click.Path(path_type=Path, file_okay=False, exists=True),
    help="The folder of clones that grade-all marked: scores of other commits are said.",
)
def compare(scores: Path, gradebook: Path, slug: str, clones: Path | None) -> int:
    """List the students whose points in Classroom 50 are not those of your own machine.

    SCORES is scores.json of Classroom 50, GRADEBOOK the gradebook.csv that grade-all wrote for the same
    commits. Exit status 0: all are equal, 1: some are not.
    """
    rows = compared(scores.read_bytes(), gradebook.read_bytes(), slug, clones)
    for line in report_lines(rows):
        click.echo(line)
    return 1 if any(row.differs for row in rows) else 0
