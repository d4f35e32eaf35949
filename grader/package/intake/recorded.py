"""The exec bits that the student gave the package's files, as far as they are known."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from grader.package.intake.model import SourceFile
from grader.package.intake.modes import git_ignores_modes, git_modes
from grader.package.intake.reading import Unread
from grader.package.intake.tree import Tree, ancestors, join
from grader.report.model import Modes


def with_modes(
    tree: Tree, root: str | None, files: tuple[SourceFile, ...]
) -> tuple[tuple[SourceFile, ...], Modes]:
    """Return the files with the exec bits that the student gave them, as far as they are known.

    If git ignores them, the file system has none, or the archive was made on Windows, the index
    of a checkout still records them.
    """
    if root is None:
        return files, "recorded"

    def read(path: Path, limit: int) -> bytes | Unread:
        return tree.place.read(path.as_posix(), limit)

    repository = next((place for place in ancestors(root) if place in tree.git), None)
    ignored = repository is not None and git_ignores_modes(Path(repository), read)
    recorded = [not ignored and tree.place.records_modes(join(root, file.path)) for file in files]
    if all(recorded[n] for n, file in enumerate(files) if file.kind == "file"):
        return files, "recorded"
    index = git_modes(Path(repository), read) if repository is not None else {}
    found = [
        file.mode if known else index.get(_below(repository, join(root, file.path)))
        for file, known in zip(files, recorded, strict=True)
        if file.kind == "file"
    ]
    plain = [file for file in files if file.kind == "file"]
    python = [m for f, m in zip(plain, found, strict=True) if f.path.endswith(".py")]
    if not python or any(mode is None for mode in python):
        return files, "unknown"
    modes = {f.path: m for f, m in zip(plain, found, strict=True) if m is not None}
    return tuple(replace(f, mode=modes.get(f.path, f.mode)) for f in files), "recorded"


def _below(folder: str | None, path: str) -> str:
    """Return a path of the tree relative to a folder above it."""
    return path if folder in (None, ".") else path[len(folder) + 1 :]
