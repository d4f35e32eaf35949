"""Mutants kept as packages, for an instructor who wants to see what a student would get for one."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from grader.base.errors import UsageError
from grader.course.assignment import Assignment
from grader.package.edit.tree import Tree, write_tree
from grader.validate.mutant import Mutant

LONGEST_NAME = 100  # characters of a folder
OTHER = re.compile(r"[^A-Za-z0-9_.+-]+")


def keep(mutants: Iterable[Mutant], solution: Tree, assignment: Assignment, folder: Path) -> None:
    """Write each mutant to a folder of its own below `folder`.

    Raises UsageError if `folder` has files already, or cannot be written.
    """
    try:
        if folder.exists() and any(folder.iterdir()):
            raise UsageError(
                f"{folder} is not empty",
                remedy="Name a folder that does not exist yet: validate deletes nothing.",
            )
        for mutant in mutants:
            write_tree(mutant.of(solution), _free(folder, mutant.name) / assignment.package)
    except OSError as error:
        raise UsageError(f"the mutants cannot be written to {folder}: {error.strerror}") from None


def _free(folder: Path, name: str) -> Path:
    """Return a folder for a mutant that is not there yet."""
    stem = OTHER.sub("_", name).strip("_.")[:LONGEST_NAME] or "mutant"
    place, number = folder / stem, 1
    while place.exists():
        number += 1
        place = folder / f"{stem}_{number}"
    return place
