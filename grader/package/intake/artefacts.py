"""What tools leave in a folder and generate again: colcon's trees, caches, editor and system files.

A name alone is not enough: a student's own module may be called `log` or `build`. colcon's
folders are recognised by their contents (colcon-core writes `COLCON_IGNORE` into all three,
`.colcon_install_layout` into install and the link `latest` into log).
"""

from __future__ import annotations

from collections.abc import Set
from itertools import islice

from grader.package.intake.place import Place

COLCON = frozenset({"build", "install", "log"})
FOLDERS = frozenset(
    {
        *(".git", ".hg", ".svn", ".vscode", ".idea", ".vs"),
        *("__pycache__", ".mypy_cache", ".pytest_cache", ".ruff_cache", ".tox", ".nox", ".eggs"),
        *("node_modules", "__MACOSX", ".Trash", ".Trashes", ".Spotlight-V100", ".fseventsd"),
        *(".ipynb_checkpoints", "System Volume Information"),
    }
)
LAB, SUBMIT = ".lab", "submit"
"""The lab's folders in a workspace: its own files, with the backups, and the archives to hand in."""
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


def is_colcon_artefact(place: Place, folder: str, beside: Set[str]) -> bool:
    """Whether a folder called build, install or log was made by colcon or by setup.py build.

    `beside` are those of the three names that are side by side: colcon makes all three, so if
    one is recognised, all are.
    """
    if "__init__.py" in _names(place, folder):
        return False
    above = folder.rpartition("/")[0]
    return any(_is_marked(place, f"{above}/{name}" if above else name) for name in beside)


def _is_marked(place: Place, folder: str) -> bool:
    names = _names(place, folder)
    if "__init__.py" in names:
        return False
    kind = folder.rpartition("/")[2]
    if names & MARKS[kind]:
        return True
    starts = ("build_20", "list_20", "test_20", "bdist.", "temp.")
    if any(name.startswith(starts) for name in names):
        return True
    return kind == "build" and any(
        not _is_link(place, f"{folder}/{name}")
        and "colcon_build.rc" in _names(place, f"{folder}/{name}")
        for name in sorted(names)[:20]
    )


def _is_link(place: Place, path: str) -> bool:
    try:
        entry = place.entry(path)
    except OSError:
        return False
    return entry is not None and entry.kind == "link"


def _names(place: Place, folder: str) -> set[str]:
    try:
        return set(islice(place.names(folder), MOST_PEEKED))
    except OSError:
        return set()


def is_tool_folder(place: Place, folder: str) -> bool:
    """Whether a folder belongs to a tool and not to the package."""
    name = folder.rpartition("/")[2]
    if name in (".venv", "venv", "env", ".env"):
        return "pyvenv.cfg" in _names(place, folder) or name == ".venv"
    return name in FOLDERS or name.endswith((".egg-info", ".dist-info"))


def is_tool_file(name: str) -> bool:
    """Whether a file belongs to a tool, an editor or the system."""
    return name in FILES or name.startswith("._") or name.endswith(ENDINGS)


def is_only_copy(name: str, beside: Set[str]) -> bool:
    """Whether an editor's backup of a Python file has no original beside it."""
    return name.endswith(".py~") and name[:-1] not in beside
