"""The command that writes a new lesson."""

from __future__ import annotations

import contextlib
import io
import re
from pathlib import Path

import click

NAME = re.compile(r"[a-z][a-z0-9_]*")


@click.command("new")
@click.argument("lesson")
@click.option("--package", help="Name of the students' package (default: my_LESSON).")
@click.option("--title", help="Title of the lesson (default: its name).")
@click.option(
    "--course",
    default="my_course",
    show_default=True,
    type=click.Path(file_okay=False, path_type=Path),
    help="Folder of the course, which students may see.",
)
@click.option(
    "--keys",
    default="my_keys",
    show_default=True,
    type=click.Path(file_okay=False, path_type=Path),
    help="Folder of the solutions, never for students.",
)
def new(lesson: str, package: str | None, title: str | None, course: Path, keys: Path) -> int:
    """Write the files of a new lesson: assignment, text, solution and mutants to start from.

    The lesson can be marked at once; change its files step by step. Nothing is overwritten.
    """
    from grader.base.errors import UsageError  # noqa: PLC0415 - keeps --help fast
    from grader.cli.new_lesson import write_lesson  # noqa: PLC0415

    package = package or f"my_{lesson}"
    for name in (lesson, package):
        if not NAME.fullmatch(name):
            raise UsageError(
                f"'{name}' cannot be a name",
                remedy="Use lower case letters, digits and _, with a letter first.",
            )
    shown = title or lesson.replace("_", " ").capitalize()
    if not shown.isprintable() or set(shown) & set('"\\{}<>&'):
        raise UsageError("the title must be one line without quotes, brackets and backslashes")
    with contextlib.redirect_stdout(io.StringIO()):  # `ros2 pkg create` names each of its files
        paths = write_lesson(lesson, package, shown, course, keys)
    for path in paths:
        click.echo(f"wrote  {path}")
    click.echo(f"wrote  {keys / lesson / 'solution' / package}")
    click.echo("\nChange them, and see after each change whether the lesson marks what it must:")
    file = course / lesson / "assignment.yaml"
    click.echo(f"  grader validate {file} --keys {keys / lesson} --named")
    return 0
