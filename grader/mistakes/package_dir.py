"""The texts about a `package_dir` that leads to a folder which is not there."""

from __future__ import annotations

from grader.base.i18n.message import msg

SOURCE_FOLDER = msg(
    "package_dir tells setuptools that the packages are in another folder. The build finds no "
    "package there, so ros2 run cannot import the node: ModuleNotFoundError."
)
SOURCE_FOLDERS = {
    "package_dir_alone": msg(
        "package_dir leads to the folder {name}, and the package has no such folder. Delete "
        "package_dir, then build again: without it, setuptools looks for the packages beside "
        "setup.py."
    ),
    "package_dir": msg(
        "package_dir leads to the folder {name}, and the package has no such folder. Delete "
        "package_dir and write {wanted}, then build again."
    ),
}
"""What to do, by variant."""
