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


def keep(
    mutants: Iterable[Mutant], solution: Tree, assignment: Assignment, folder: Path
) -> dict[str, Path]:
    """Write each mutant to a folder of its own below `folder`; return the folders by its name.

    Raises UsageError if `folder` has files already, or cannot be written.
    """
    try:
        if folder.exists() and any(folder.iterdir()):
            raise UsageError(
                f"{folder} is not empty",
                remedy="Name a folder that does not exist yet: validate deletes nothing.",
            )
        places: dict[str, Path] = {}
        for mutant in mutants:
            place = _free(folder, mutant.name, places.values())
            write_tree(mutant.of(solution), place / assignment.package)
            places[mutant.name] = place
    except OSError as error:
        raise UsageError(f"the mutants cannot be written to {folder}: {error.strerror}") from None
    return places


def _free(folder: Path, name: str, taken: Iterable[Path]) -> Path:
    stem = OTHER.sub("_", name).strip("_.")[:LONGEST_NAME] or "mutant"
    place, used, number = folder / stem, {*taken}, 1
    while place in used:
        number += 1
        place = folder / f"{stem}_{number}"
    return place
