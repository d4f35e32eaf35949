"""The command that explains a mistake."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

import click

from grader.base.errors import UsageError
from grader.base.i18n.message import msg, say
from grader.base.i18n.translator import Translator, chosen_language, errors_in
from grader.cli import options
from grader.cli.piped import interrupts_ignored, read_and_echo

if TYPE_CHECKING:
    from grader.course.assignment import Assignment
    from grader.explain.explanation import Reader


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
    from grader.explain import explanation  # noqa: PLC0415 - keeps --help fast
    from grader.explain.machine import Machine  # noqa: PLC0415
    from grader.ros.distro import find_distro  # noqa: PLC0415

    lang = lang or chosen_language(os.environ)
    with errors_in(lang):
        machine = Machine()
        reader = explanation.Reader(
            lang,
            find_distro(distro) if distro else machine.distro,
            _lesson(assignment),
            machine,
        )
    if mistake is None:
        explanation.print_list(file=sys.stdout, reader=reader)
        return 0
    if mistake == "-":
        return _explain_input(reader)
    explanation.print_entry(mistake, file=sys.stdout, reader=reader)
    return 0


def _explain_input(reader: Reader) -> int:
    from grader.explain.explanation import print_recognised  # noqa: PLC0415

    if sys.stdin is not None and sys.stdin.isatty():
        hint = say("Paste the output of the terminal here, then press Ctrl+D on an empty line.")
        click.echo(Translator(reader.lang)(hint), err=True)
        text = sys.stdin.read()
        return 0 if print_recognised(text, file=sys.stdout, reader=reader) else 1
    with interrupts_ignored():
        text = read_and_echo(sys.stdin.buffer if sys.stdin is not None else None, sys.stdout)
        return 0 if print_recognised(text, file=sys.stdout, reader=reader) else 1


def _lesson(assignment: str | None) -> Assignment | None:
    """Return the chosen lesson; None if none was named and the course has no single lesson."""
    from grader.course.find import assignment_file  # noqa: PLC0415
    from grader.course.load import load_assignment  # noqa: PLC0415

    try:
        return load_assignment(assignment_file(assignment))
    except UsageError:
        if assignment is None:
            return None
        raise
