"""What a command is called where its output is read: in the lab, through make, or as `grader`."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from grader.base.i18n.message import joined, msg, say
from grader.course.after import After, hand_in
from grader.report.detail import HINTS

CALLED_BY = "GRADER_CALLED_BY"
"""The variable by which the Makefile says that it calls the grader (`make`)."""
THE_SAME = msg("the same command with {switch}")


@dataclass(frozen=True)
class Commands:
    """The commands that a reader can type.

    `hint` shows the next hint, with `{n}` for how many are asked for;
    `explain` shows everything about each failure; `rest` says how to get the whole report.
    """

    hint: str
    explain: str
    rest: str
    in_lab: bool = False

    def next_lesson(self, after: After) -> str:
        """Return what comes after a success: the next lesson, in the lab handing in before it."""
        if self.in_lab:
            return hand_in(after.in_lab(os.environ))
        if not after.id:
            return ""
        return joined(after.title, f"make lab LESSON={after.id}", by=": ")

    def next_hint(self, seen: int) -> str:
        """Return how to get the next hint after so many, "" if there is none."""
        if seen >= HINTS:
            return ""
        return say(
            "{command}: more about this. {all}: everything at once.",
            command=self.hint.replace("{n}", str(seen + 1)),
            all=self.explain,
        )


def commands_for(name: str, *, in_lab: bool, environment: Mapping[str, str]) -> Commands:
    """Return the commands for `check` or `grade` (`name`), as they are called here."""
    if in_lab:
        return Commands("lab hint", "check --explain", "check -v", True)
    if environment.get(CALLED_BY) == "make":
        made = f"make {name}"
        return Commands(f"{made} HINTS={{n}}", f"{made} EXPLAIN=1", say(THE_SAME, switch="ALL=1"))
    typed = f"{program()} {name}"
    return Commands(f"{typed} --hints {{n}}", f"{typed} --explain", say(THE_SAME, switch="--all"))


def program() -> str:
    """Return how this program was started: `grader`, its path, or `python -m grader`."""
    given = Path(sys.argv[0])
    if given.name == "__main__.py" and given.parent.name == "grader":
        return f"{sys.orig_argv[0]} -m grader"
    if given.name != "grader" or _is_found(given):
        return "grader"
    return os.path.relpath(given) if given.is_relative_to(Path.cwd()) else str(given)


def _is_found(program: Path) -> bool:
    found = shutil.which("grader")
    return found is not None and Path(found).resolve() == program.resolve()
