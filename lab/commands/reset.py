"""`lab reset STEP`: takes a step's work away, so that it can be done again, and keeps it."""

from __future__ import annotations

import os
import re
import shutil
import sys
from collections.abc import Iterator
from datetime import datetime, timezone
from pathlib import Path
from typing import TYPE_CHECKING

import click

from grader.base.errors import UsageError
from grader.base.i18n.message import msg, say
from grader.base.i18n.translator import errors_in
from grader.cli import options

if TYPE_CHECKING:
    from lab.guide.opened import OpenedLab

BACKUPS = ".lab/backups"
BUILT = ("build", "install", "log")


@click.command(
    help=msg(
        "Start again at STEP (its number): what you made in that step is moved to "
        "~/ros2_ws/.lab/backups. Without --yes, the command shows what it would move, and asks."
    )
)
@click.argument("step", type=int)
@click.option("--yes", is_flag=True, help=msg("Do it without asking."))
@options.lang
def reset(step: int, yes: bool, lang: str | None) -> int:
    """Move the files of a step away."""
    from lab.guide.opened import opened_lab  # noqa: PLC0415 - keeps --help fast

    with errors_in(lang):
        lab = opened_lab(lang)
        translate = lab.translate
        paths = list(_made_in(lab, step))
        if not paths:
            click.echo(translate(say("There is nothing of this step to move away.")))
            return 0
        for path in paths:
            click.echo(translate(say("moves {path}", path=_short(lab, path))))
        if not yes and not _agreed(lab):
            click.echo(translate(say("Nothing was moved.")))
            return 1
        try:
            backup = _move(lab, paths)
        except OSError as error:
            raise UsageError(
                say(
                    "the files cannot be moved to ~/ros2_ws/{folder}: {problem}",
                    folder=BACKUPS,
                    problem=error.strerror or str(error),
                ),
                remedy=say("Correct that, and run `lab reset` again."),
            ) from None
        click.echo(translate(say("Moved to {path}.", path=_short(lab, backup))))
        return 0


def _agreed(lab: OpenedLab) -> bool:
    if not sys.stdin.isatty():
        click.echo(lab.translate(say("To do it, run the command with --yes.")))
        return False
    return click.confirm(lab.translate(say("Move these files?")))


def _made_in(lab: OpenedLab, number: int) -> Iterator[Path]:
    """Yield what exists of what a student makes in a step. UsageError if there is no such step."""
    steps = {step.number: step for step in lab.lesson.steps}
    if number not in steps:
        raise UsageError(
            say("there is no step '{word}'", word=number),
            remedy=say("Steps: {first} to {last}.", first=min(steps), last=max(steps)),
        )
    own = lab.workspace / "src" / lab.assignment.package
    made = {
        "workspace": [own, *(lab.workspace / name for name in BUILT)],
        "package": [own],
        "package_build": [lab.workspace / name for name in BUILT],
        "executable": [lab.workspace / name for name in BUILT],
        "node_file": [own / lab.assignment.package / lab.assignment.node_file],
        "node": [own / lab.assignment.package / lab.assignment.node_file],
        "entry_point": [own / "setup.py"],
        "interfaces": [lab.workspace / "src" / n for n in lab.assignment.interface_packages],
        "interfaces_build": [lab.workspace / name for name in BUILT],
    }
    for path in made.get(steps[number].done.partition(" ")[0], []):
        if os.path.lexists(path):
            yield path


def _move(lab: OpenedLab, paths: list[Path]) -> Path:
    """Move files to a new folder of the backups, and return it. OSError if it cannot be done."""
    name = datetime.now(timezone.utc).strftime("%Y%m%d-%H%M%S-%f")
    backup = lab.workspace / BACKUPS / name
    backup.mkdir(parents=True)
    (backup.parent / "COLCON_IGNORE").touch()  # (it skips hidden folders too)
    for path in paths:
        target = backup / path.relative_to(lab.workspace)
        target.parent.mkdir(parents=True, exist_ok=True)
        if path.name == "setup.py":
            shutil.copy2(path, target)
            _without_entry(path, lab.assignment.executable)
        else:
            path.rename(target)
    return backup


def _without_entry(setup: Path, executable: str) -> None:
    """Remove the entry of an executable from setup.py, and nothing else."""
    text = setup.read_text(encoding="utf-8", errors="surrogateescape")
    entry = re.compile(
        rf"^[ \t]*(['\"]){re.escape(executable)}\s*=[^'\"\n]*\1,?[ \t]*\n", re.MULTILINE
    )
    setup.write_text(entry.sub("", text), encoding="utf-8", errors="surrogateescape")


def _short(lab: OpenedLab, path: Path) -> str:
    return f"~/ros2_ws/{path.relative_to(lab.workspace)}"
