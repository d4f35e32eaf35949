"""Archives inside a submission, read if the package is nowhere else."""

# ruff: noqa: D102 - Place documents the methods

from __future__ import annotations

import io
from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import islice
from typing import IO, Literal

from grader.package.intake.archive import Archive, read_archive
from grader.package.intake.archive_kind import HEAD, Kind, is_named_archive, kind_of
from grader.package.intake.archive_limits import Spent
from grader.package.intake.archive_problems import ArchiveError, corrupt, too_deep
from grader.package.intake.choose import find_candidates
from grader.package.intake.place import Entry, Place
from grader.package.intake.problems import Problem
from grader.package.intake.reading import Unread
from grader.package.intake.tree import Tree, ancestors, look

MOST_TRIED = 50
"""How many files are tested for being archives."""


class Opened:
    """A place in which some archives are opened: they look like folders of the same name."""

    def __init__(self, base: Place, archives: dict[str, Archive]) -> None:
        self.name = base.name
        self._base = base
        self._archives = archives

    def origin(self, path: str) -> Literal["directory", "zip", "tar"]:
        place, inner = self._find(path)
        return place.origin(inner)

    def names(self, folder: str) -> Iterable[str]:
        place, inner = self._find(folder)
        return place.names(inner)

    def entry(self, path: str) -> Entry | None:
        place, inner = self._find(path)
        if inner == ".":
            return Entry(path, "folder", 0o755)
        found = place.entry(inner)
        return found and replace(found, path=path)

    def read(self, path: str, limit: int) -> bytes | Unread:
        place, inner = self._find(path)
        return place.read(inner, limit)

    def open(self, path: str) -> IO[bytes] | Unread:
        place, inner = self._find(path)
        return place.open(inner)

    def records_modes(self, path: str) -> bool:
        place, inner = self._find(path)
        return place.records_modes(inner)

    def remarks(self) -> Iterator[tuple[str, str]]:
        yield from self._base.remarks()
        for path, archive in self._archives.items():
            for reason, where in archive.remarks():
                yield reason, f"{path}/{where}"

    def _find(self, path: str) -> tuple[Place, str]:
        for above in ancestors(path):
            if above in self._archives:
                return self._archives[above], path[len(above) + 1 :] or "."
        return self._base, path


def look_inside(place: Place, spent: Spent) -> tuple[Tree, Problem | None]:
    """Read a place and, if it contains no package, the archives in it.

    Returns the tree with the archives as folders, and the first problem if some archives could
    not be opened. Raises OSError if the place cannot be read.
    """
    tree = look(place)
    opened: dict[str, Archive] = {}
    tried: set[str] = set()
    problem: Problem | None = None
    for depth in range(spent.limits.depth + 1):
        found = [] if find_candidates(tree) else list(_archives_in(tree))
        new = [(path, kind) for path, kind in found if path not in tried]
        if not new:
            break
        for path, kind in new:
            tried.add(path)
            try:
                if depth == spent.limits.depth:
                    raise ArchiveError(too_deep(path, depth))
                opened[path] = _open(tree.place, path, kind, spent)
            except ArchiveError as error:
                problem = problem or error.problem
        tree = look(Opened(place, opened))
    return tree, problem


def _archives_in(tree: Tree) -> Iterator[tuple[str, Kind]]:
    """Yield the files that are archives, among those whose names may be an archive's."""
    likely = (
        path
        for path, entry in sorted(tree.entries.items())
        if entry.kind == "file" and _may_be(path.rpartition("/")[2])
    )
    for path in islice(likely, MOST_TRIED):
        opened = tree.place.open(path)
        if isinstance(opened, Unread):
            continue
        with opened as file:
            kind = kind_of(file.read(HEAD))
        if kind is not None:
            yield path, kind


def _may_be(name: str) -> bool:
    """Whether a file may be an archive: a document or a wheel is a zip too, but not meant here."""
    return is_named_archive(name) or "." not in name


def _open(place: Place, path: str, kind: Kind, spent: Spent) -> Archive:
    opened = place.open(path)
    if isinstance(opened, Unread):
        raise ArchiveError(corrupt(path, opened.reason))
    with opened as file:
        size = file.seek(0, io.SEEK_END)
        file.seek(0)
        spent.archive(path, size, outermost=place.origin(path) == "directory")
        return read_archive(file, kind, path, spent)
