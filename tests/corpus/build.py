"""Write a package of the corpus to disk."""

from __future__ import annotations

from pathlib import Path

from grader.package.edit.tree import EditError, apply_all, read_tree, write_tree

from .model import Package

ROOT = Path(__file__).parents[2]
SOLUTION = ROOT / "grader/keys/hello_time/solution/my_robot_controller"


def write(package: Package, folder: Path) -> Path:
    """Write the package to `folder/<its name in the corpus>` and return that path.

    Raise EditError if an edit does not apply, FileExistsError if the path exists.
    """
    try:
        tree = apply_all(package.edits, read_tree(SOLUTION))
    except EditError as error:
        raise EditError(f"{package.name}: {error}") from error
    root = folder / package.name
    write_tree(tree, root)
    return root
