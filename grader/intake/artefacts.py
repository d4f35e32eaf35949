"""What tools leave in a folder and make anew: colcon's trees, caches, editors' and systems' files.

A name alone does not tell: a student's own module may be called `log` or `build`. colcon's
folders are known by what is in them (colcon-core writes `COLCON_IGNORE` into all three,
`.colcon_install_layout` into install and the link `latest` into log).
"""

from __future__ import annotations

import os
from collections.abc import Set
from pathlib import Path

COLCON = frozenset({"build", "install", "log"})
FOLDERS = frozenset(
    {
        *(".git", ".hg", ".svn", ".vscode", ".idea", ".vs"),
        *("__pycache__", ".mypy_cache", ".pytest_cache", ".ruff_cache", ".tox", ".nox", ".eggs"),
        *("node_modules", "__MACOSX", ".Trash", ".Trashes", ".Spotlight-V100", ".fseventsd"),
        *(".ipynb_checkpoints", "System Volume Information"),
    }
)
FILES = frozenset({".git", ".DS_Store", "Thumbs.db", "desktop.ini"})
ENDINGS = (".pyc", ".pyo", ".swp", ".swo", "~")
MARKS = {
    "build": {"COLCON_IGNORE", ".built_by", "lib", "CMakeCache.txt"},
    "install": {
        *("COLCON_IGNORE", ".colcon_install_layout", "_local_setup_util_sh.py"),
        *("setup.bash", "local_setup.bash"),
    },
    "log": {"COLCON_IGNORE", "latest", "latest_build", "latest_list"},
}
MOST_PEEKED = 1_000


def is_colcon_artefact(folder: Path, beside: Set[str]) -> bool:
    """Whether a folder called build, install or log was made by colcon or by setup.py build.

    `beside` are those of the three names that lie side by side: colcon makes all three, so that
    one that is known makes the others known.
    """
    if "__init__.py" in _names(folder):
        return False
    return any(_is_marked(folder.parent / name) for name in beside)


def _is_marked(folder: Path) -> bool:
    names = _names(folder)
    if "__init__.py" in names:
        return False
    if names & MARKS[folder.name]:
        return True
    starts = ("build_20", "list_20", "test_20", "bdist.", "temp.")
    if any(name.startswith(starts) for name in names):
        return True
    return folder.name == "build" and any(
        not (folder / name).is_symlink() and "colcon_build.rc" in _names(folder / name)
        for name in sorted(names)[:20]
    )


def _names(folder: Path) -> set[str]:
    found = set()
    try:
        with os.scandir(folder) as entries:
            for entry in entries:
                found.add(entry.name)
                if len(found) >= MOST_PEEKED:
                    break
    except OSError:
        return set()
    return found


def is_tool_folder(name: str, folder: Path) -> bool:
    """Whether a folder belongs to a tool and not to the package."""
    if name in (".venv", "venv", "env", ".env"):
        return "pyvenv.cfg" in _names(folder) or name == ".venv"
    return name in FOLDERS or name.endswith((".egg-info", ".dist-info"))


def is_tool_file(name: str) -> bool:
    """Whether a file belongs to a tool, an editor or the system."""
    return name in FILES or name.startswith("._") or name.endswith(ENDINGS)
