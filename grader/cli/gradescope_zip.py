"""The command that makes the autograder archive for Gradescope."""

from __future__ import annotations

import os
from pathlib import Path

import click

from grader.base.errors import SurroundingsError
from grader.base.folder import Folder
from grader.base.i18n.translator import chosen_language
from grader.cli import options


@click.command("gradescope-zip")
@click.argument("out", type=click.Path(path_type=Path), default=Path("autograder.zip"))
@options.assignment
@options.keys
@options.one_distro
@options.container_sandbox
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
    from grader.batch.systems.gradescope import archive  # noqa: PLC0415 - keeps --help fast
    from grader.ros.distro import find_distro  # noqa: PLC0415
    from grader.sandbox.names import check_name  # noqa: PLC0415

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


def _write(path: Path, content: bytes) -> None:
    """Write a file that only its owner can read; an old one is replaced once it is complete."""
    try:
        with Folder.open(path.parent) as folder:
            folder.replace(path.name, content)
    except OSError as error:
        reason = os.strerror(error.errno) if error.errno else str(error)
        raise SurroundingsError(
            f"{path} could not be written: {reason}", remedy="Choose another path."
        ) from None
