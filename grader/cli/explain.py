"""The command that explains a mistake."""

from __future__ import annotations

import os
import sys

import click

from grader.base.errors import UsageError
from grader.base.i18n.message import msg
from grader.base.i18n.translator import chosen_language, errors_in
from grader.cli import options
from grader.course.assignment import Assignment
from grader.course.find import assignment_file
from grader.course.load import load_assignment
from grader.mistakes import explanation
from grader.ros.distro import find_distro, sourced


@click.command(
    help=msg(
        "Explain a mistake of the catalogue, or the output of a terminal (-: from standard "
        "input).\n\n"
        "For example: ros2 run my_package my_node 2>&1 | grader explain -"
    )
)
@click.argument("mistake", metavar="[MISTAKE-ID | -]", required=False)
@options.assignment
@click.option(
    "--distro",
    help=msg("The ROS 2 distro whose documentation is linked (default: the sourced one)."),
)
@options.lang
def explain(
    mistake: str | None, assignment: str | None, distro: str | None, lang: str | None
) -> int:
    """Explain a mistake of the catalogue, or the output of a terminal."""
    lang = lang or chosen_language(os.environ)
    with errors_in(lang):
        reader = explanation.Reader(
            lang,
            find_distro(distro) if distro else sourced(os.environ),
            _lesson(assignment),
        )
    if mistake is None:
        explanation.print_list(file=sys.stdout, reader=reader)
        return 0
    if mistake == "-":
        text = sys.stdin.buffer.read(explanation.MOST_BYTES).decode("utf-8", "replace")
        return 0 if explanation.print_recognised(text, file=sys.stdout, reader=reader) else 1
    explanation.print_entry(mistake, file=sys.stdout, reader=reader)
    return 0


def _lesson(assignment: str | None) -> Assignment | None:
    """Return the chosen lesson; None if none was named and the course has no single lesson."""
    try:
        return load_assignment(assignment_file(assignment))
    except UsageError:
        if assignment is None:
            return None
        raise
