"""The command that prints one report in another system's format."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import click

from grader.base.gate import bytes_of
from grader.batch.systems.known import report_forms
from grader.cli import options

if TYPE_CHECKING:
    from grader.report.model import Report

OF_SYSTEMS = report_forms()
FORMS = [*OF_SYSTEMS, "json", "junit", "md"]


@click.command("convert")
@click.argument("form", type=click.Choice(FORMS))
@click.argument("report", type=click.Path(path_type=Path))
@click.option("--show-hidden", is_flag=True, help="Name the hidden checks.")
@options.feedback
def convert(form: str, report: Path, show_hidden: bool, feedback: str) -> int:
    """Print a report.json in the format of another system (FORM), in the report's language.

    `json` is report.json as a student may read it.
    """
    made = _forms(show_hidden=show_hidden)[form](_read(report, feedback))
    content = made.encode() if isinstance(made, str) else made
    if sys.stdout.isatty():
        click.echo(content.decode(), nl=False)
    else:  # for a program: the exact bytes
        bytes_of(sys.stdout).write(content)
    return 0


def _forms(*, show_hidden: bool) -> dict[str, Callable[[Report], str | bytes]]:
    from grader.batch.points import single  # noqa: PLC0415 - keeps --help fast
    from grader.publish import junit  # noqa: PLC0415
    from grader.publish.markdown import markdown  # noqa: PLC0415
    from grader.report.feedback import handed_back, without_hidden  # noqa: PLC0415
    from grader.report.files import report_json  # noqa: PLC0415

    def seen(report: Report) -> Report:
        return handed_back(report, show_hidden=show_hidden)

    def named(report: Report) -> Report:
        return seen(report) if show_hidden else without_hidden(seen(report))

    return {
        **{name: partial(_as_in, form, show_hidden) for name, form in OF_SYSTEMS.items()},
        "json": lambda r: report_json(named(r)),
        "junit": lambda r: junit.report_xml(named(r)),
        "md": lambda r: markdown(single(seen(r)), r.assignment.title, show_hidden=show_hidden),
    }


def _as_in(form: Callable[[Report, bool], str], show_hidden: bool, report: Report) -> str:
    return form(report, show_hidden)


def _read(path: Path, feedback: str) -> Report:
    from grader.report.feedback import with_rules  # noqa: PLC0415 - keeps --help fast
    from grader.report.files import read_report  # noqa: PLC0415

    return with_rules(read_report(path), feedback)
