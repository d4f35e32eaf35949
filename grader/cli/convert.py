"""The commands for Gradescope, and `convert`: one report in another system's format."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import click

from grader.base.errors import SurroundingsError, UsageError
from grader.base.gate import bytes_of
from grader.base.i18n.translator import chosen_language
from grader.batch.systems.known import report_forms
from grader.cli import options

if TYPE_CHECKING:
    from grader.report.model import Report

OF_SYSTEMS = report_forms()
FORMS = [*OF_SYSTEMS, "junit", "md"]
_sandbox = click.option(
    "--sandbox",
    default="account",
    show_default=True,
    help="Where the student's code runs in Gradescope's container.",
)


@click.command("gradescope")
@click.argument("autograder", type=click.Path(path_type=Path), default=Path("/autograder"))
@options.assignment
@options.keys
@options.one_distro
@_sandbox
@options.lang
def gradescope(
    autograder: Path,
    assignment: str | None,
    keys: Path | None,
    distro: str,
    sandbox: str,
    lang: str | None,
) -> int:
    """Mark the submission in Gradescope's container and keep results.json up to date.

    AUTOGRADER is the folder that Gradescope made (default: /autograder).
    """
    from grader.batch.systems.gradescope.container import run  # noqa: PLC0415 - keeps --help fast

    return run(
        autograder, assignment=assignment, keys=keys, distro=distro, sandbox=sandbox, lang=lang
    )


@click.command("gradescope-zip")
@click.argument("out", type=click.Path(path_type=Path), default=Path("autograder.zip"))
@options.assignment
@options.keys
@options.one_distro
@_sandbox
@options.lang
def gradescope_zip(
    out: Path,
    assignment: str | None,
    keys: Path | None,
    distro: str,
    sandbox: str,
    lang: str | None,
) -> int:
    """Make the autograder archive to upload to Gradescope. It contains the solution.

    --lang is the language of the results that students read.

    OUT is the file to write (default: autograder.zip).
    """
    from grader.batch.systems.gradescope import archive  # noqa: PLC0415
    from grader.ros.distro import find_distro  # noqa: PLC0415
    from grader.sandbox.choose import check_name  # noqa: PLC0415

    check_name(sandbox)
    name = find_distro(distro).name
    made = archive.gradescope_zip(
        assignment=assignment,
        keys=keys,
        distro=name,
        sandbox=sandbox,
        lang=lang or chosen_language(os.environ),
    )
    _write(out, made)
    click.echo(f"{out}: {len(made):,} bytes. Keep it from students: it contains the solution.")
    return 0


@click.command("convert")
@click.argument("form", type=click.Choice(FORMS))
@click.argument("report", type=click.Path(path_type=Path))
@click.option("--show-hidden", is_flag=True, help="Name the hidden checks.")
def convert(form: str, report: Path, show_hidden: bool) -> int:
    """Print a report.json in the format of another system (FORM), in the report's language.

    `github` prints the line for $GITHUB_OUTPUT: grader convert github REPORT >> "$GITHUB_OUTPUT".
    """
    made = _forms(show_hidden=show_hidden)[form](_read(report))
    content = made.encode() if isinstance(made, str) else made
    if sys.stdout.isatty():
        click.echo(content.decode(), nl=False)
    else:  # for a program: the exact bytes
        bytes_of(sys.stdout).write(content)
    return 0


COMMANDS = (gradescope, gradescope_zip, convert)


def _forms(*, show_hidden: bool) -> dict[str, Callable[[Report], str | bytes]]:
    from grader.batch.points import single  # noqa: PLC0415
    from grader.publish import junit  # noqa: PLC0415
    from grader.publish.markdown import markdown  # noqa: PLC0415

    return {
        **{name: partial(_as_in, form, show_hidden) for name, form in OF_SYSTEMS.items()},
        "junit": junit.report_xml,
        "md": lambda r: markdown(single(r), r.assignment.title, show_hidden=show_hidden),
    }


def _as_in(form: Callable[[Report, bool], str], show_hidden: bool, report: Report) -> str:
    return form(report, show_hidden)


def _read(path: Path) -> Report:
    from pydantic import ValidationError  # noqa: PLC0415

    from grader.report.model import Report  # noqa: PLC0415

    try:
        return Report.model_validate_json(path.read_bytes())
    except OSError as error:
        raise UsageError(f"{path} cannot be read: {error.strerror}") from None
    except ValidationError as error:
        first = error.errors()[0]
        raise UsageError(f"{path} is not a report of this grader: {first['msg']}") from None


def _write(path: Path, content: bytes) -> None:
    """Write a file that only its owner can read; an old one is replaced once it is complete."""
    from grader.base.folder import Folder  # noqa: PLC0415

    try:
        with Folder.open(path.parent) as folder:
            folder.replace(path.name, content)
    except OSError as error:
        reason = os.strerror(error.errno) if error.errno else str(error)
        raise SurroundingsError(
            f"{path} could not be written: {reason}", remedy="Choose another path."
        ) from None
