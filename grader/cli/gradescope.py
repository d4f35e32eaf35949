"""The command that Gradescope's container runs."""

from __future__ import annotations

from pathlib import Path

import click

from grader.cli import options


@click.command("gradescope")
@click.argument("autograder", type=click.Path(path_type=Path), default=Path("/autograder"))
@options.assignment
@options.keys
@options.one_distro
@options.container_sandbox
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
