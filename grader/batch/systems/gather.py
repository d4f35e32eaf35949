"""Copies one student's loose files into a folder of their own."""

from __future__ import annotations

import hashlib
import os
import shutil
import tempfile
from collections.abc import Iterable
from pathlib import Path

from grader.base.errors import SurroundingsError
from grader.base.shown import shown
from grader.package.intake.archive_limits import ArchiveLimits
from grader.package.intake.reading import Unread, open_file

MOST_FILES = 1_000  # of one student; the rest are not copied


class Gatherer:
    """Creates folders below `root`; the same files give the same folder."""

    def __init__(self, root: Path) -> None:
        self._root = root

    def __call__(self, files: Iterable[tuple[Path, str]]) -> Path:
        """Return a folder with copies of the files, each under its given name.

        Files too large to be marked are left out. Raises SurroundingsError if the folder cannot be
        created.
        """
        wanted = _with_unique_names(list(files)[:MOST_FILES])
        try:
            target = self._root / f"files-{_digest(wanted)}"
            return target if target.is_dir() else self._copied(target, wanted)
        except OSError as error:
            raise SurroundingsError(
                f"a student's files cannot be copied into {shown(str(self._root))}: {error.strerror}",
                remedy="Free some space, or choose another folder with --out.",
            ) from None

    def _copied(self, target: Path, files: list[tuple[Path, str]]) -> Path:
        """Copy into a temporary folder, and rename it to the target when it is complete."""
        self._root.mkdir(parents=True, exist_ok=True, mode=0o700)
        building = Path(tempfile.mkdtemp(prefix=".files-", dir=self._root))
        try:
            for path, name in files:
                _copy(path, building / name)
            building.rename(target)
        except OSError:
            shutil.rmtree(building, ignore_errors=True)
            if not target.is_dir():  # (if it is, another process was faster)
                raise
        return target


def _with_unique_names(files: list[tuple[Path, str]]) -> list[tuple[Path, str]]:
    taken: set[str] = set()
    named = []
    for path, wanted in files:
        name = wanted if wanted not in ("", ".", "..") and "/" not in wanted else path.name
        if name in taken:
            name = path.name
        taken.add(name)
        named.append((path, name))
    return named


def _digest(files: list[tuple[Path, str]]) -> str:
    digest = hashlib.sha256()
    for path, name in files:
        status = os.lstat(path)
        line = f"{path}\0{name}\0{status.st_size}\0{status.st_mtime_ns}\0"
        digest.update(os.fsencode(line))
    return digest.hexdigest()[:32]


def _copy(source: Path, target: Path) -> None:
    opened = open_file(source)
    if isinstance(opened, Unread):
        return
    with opened as file:
        if os.fstat(file.fileno()).st_size > ArchiveLimits().packed:
            return
        with target.open("xb") as out:
            shutil.copyfileobj(file, out)
