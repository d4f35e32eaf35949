"""The copies of a node's file that a build makes: a student may have edited one of them.

`colcon build` without `--symlink-install` copies each file into build/ and install/ and keeps its
time. A copy that is newer than its source was changed after the build.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice

from grader.base.i18n.message import Message, say
from grader.base.shown import shown
from grader.package.intake.reading import Unread
from grader.package.intake.tree import Tree, ancestors, join

MOST_FOLDERS = 10
"""How many folders build and install are searched."""
MOST_BYTES = 100_000
RESOLUTION = 2.0  # seconds; a zip records even seconds only


def newer_copy(tree: Tree, root: str, *, package: str, node_file: str) -> str:
    """Return the path of a copy that is newer than the node's file, or holds its lost content.

    "" if there is none. Without the times of both files, only the copy of an empty or missing file
    is returned.
    """
    path = join(root, f"{package}/{node_file}")
    source = tree.file(path)
    own = tree.place.read(source.path, MOST_BYTES) if source is not None else b""
    copies = list(_copies(tree, package, node_file))
    copies += _written_there(tree, package, node_file) if source is None else []
    for copy in copies:
        entry = tree.place.entry(copy)
        found = tree.place.read(copy, MOST_BYTES)
        if entry is None or isinstance(found, Unread) or not found.strip() or found == own:
            continue
        lost = isinstance(own, bytes) and not own.strip()
        times = (source.modified if source is not None else 0, entry.modified)
        if lost or (all(times) and times[1] > times[0] + RESOLUTION):
            return copy
    return ""


def _copies(tree: Tree, package: str, node_file: str) -> Iterator[str]:
    """Yield the copies that exist; none that a link leads to."""
    for folder in tree.made[:MOST_FOLDERS]:
        for path in _places(tree, folder, package):
            copy = f"{path}/{package}/{node_file}"
            if _is_own(tree, copy):
                yield copy


def _written_there(tree: Tree, package: str, node_file: str) -> Iterator[str]:
    """Yield a file that no build makes: the student wrote the node in the build folder."""
    for folder in tree.made[:MOST_FOLDERS]:
        path = f"{folder}/{package}/{node_file}"
        if folder.rpartition("/")[2] == "build" and _is_own(tree, path):
            yield path


def _places(tree: Tree, folder: str, package: str) -> Iterator[str]:
    """Yield where setuptools puts Python packages in build and in install."""
    if folder.rpartition("/")[2] == "build":
        yield f"{folder}/{package}/build/lib"
        yield f"{folder}/lib"
        return
    for lib in (f"{folder}/{package}/lib", f"{folder}/lib"):
        if not _is_own(tree, lib, kind="folder"):
            continue
        for name in islice(tree.place.names(lib), MOST_FOLDERS):
            if name.startswith("python3"):
                yield f"{lib}/{name}/site-packages"


def _is_own(tree: Tree, path: str, kind: str = "file") -> bool:
    """Whether a path is in the submission itself: no part of it is a link."""
    kinds = []
    for part in reversed(ancestors(path)[:-1]):
        try:
            entry = tree.place.entry(part)
        except OSError:
            return False
        kinds.append(entry.kind if entry is not None else "")
        if kinds[-1] not in ("folder", "file"):
            return False
    return kinds[-1:] == [kind] and set(kinds[:-1]) <= {"folder"}


def edited_copy(copy: str, path: str) -> Message:
    """Return the advice about a copy that is newer than the file in the package."""
    return say(
        "{copy} is newer than {path}, and different. If you edited it there, move your changes to "
        "{path} and build again: only that file counts, and a build overwrites its copies.",
        copy=shown(copy),
        path=shown(path),
    )
