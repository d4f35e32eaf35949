"""The path that the user gave: a folder or an archive, opened as a place."""

from __future__ import annotations

import hashlib
import os
import stat
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.i18n.message import joined, say
from grader.base.nearest import meant, nearest_path
from grader.base.shown import shown
from grader.package.intake.archive import read_archive
from grader.package.intake.archive_kind import HEAD, is_named_archive, kind_of
from grader.package.intake.archive_limits import Spent
from grader.package.intake.archive_problems import ArchiveError, no_archive
from grader.package.intake.place import Folder, Place
from grader.package.intake.reading import Unread, open_file

CHUNK = 1_000_000
OF_A_PACKAGE = ("package.xml", "setup.py")
MOST_ABOVE = 6  # folders above a file


def resolved(path: Path) -> Path:
    """Return the resolved path of an existing folder or file; UsageError for anything else."""
    name = shown(str(path))
    try:
        kind = os.stat(path).st_mode  # noqa: PTH116 - one call for both tests
        if stat.S_ISDIR(kind) or stat.S_ISREG(kind):
            return path.resolve()
    except FileNotFoundError:
        missing = say("there is no file or folder {name}", name=name)
        raise UsageError(missing + meant(nearest_path(path))) from None
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise cannot_be_read(path, str(reason)) from None
    raise UsageError(say("{name} is neither a folder nor a file", name=name))


def cannot_be_read(path: Path, reason: str) -> UsageError:
    """Return the error for a path that cannot be read."""
    return UsageError(say("{name} cannot be read: {reason}", name=shown(str(path)), reason=reason))


def open_place(path: Path, spent: Spent, *, modes_kept: bool) -> Place:
    """Open a resolved path.

    Raises UsageError for a file that is neither an archive nor named like one, or cannot be read,
    and ArchiveError for an archive that is refused.
    """
    if path.is_dir():
        return Folder(path, modes_kept=modes_kept)
    opened = open_file(path)
    if isinstance(opened, Unread):
        raise UsageError(joined(shown(str(path)), ": ", opened.reason, by=""))
    with opened as file:
        kind = kind_of(file.read(HEAD))
        if kind is None and is_named_archive(path.name):
            raise ArchiveError(no_archive(path.name))
        if kind is None:
            raise _only_a_file(path)
        spent.archive(path.name, os.fstat(file.fileno()).st_size, outermost=True)
        file.seek(0)
        return read_archive(file, kind, path.name, spent)


def package_above(path: Path) -> Path | None:
    """Return the nearest folder above a file that has a package.xml or a setup.py."""
    for folder in list(path.parents)[:MOST_ABOVE]:
        if any(os.path.isfile(folder / name) for name in OF_A_PACKAGE):  # noqa: PTH113 - no OSError
            return folder
    return None


def _only_a_file(path: Path) -> UsageError:
    name, folder = shown(str(path)), package_above(path)
    if folder is None:
        return UsageError(
            say("{name} is neither a folder nor an archive", name=name),
            remedy=say("Give the folder that contains the package, or a zip or tar of it."),
        )
    return UsageError(
        say("{name} is one file of a package", name=name),
        remedy=say("Give the folder of the package: {folder}", folder=shown(str(folder))),
    )


def digest_of_file(path: Path, *, most: int) -> str:
    """Return the hash of a file's size and of about its first `most` bytes."""
    digest = hashlib.sha256()
    with path.open("rb") as file:
        digest.update(f"{os.fstat(file.fileno()).st_size}:".encode())
        while most > 0 and (chunk := file.read(CHUNK)):
            digest.update(chunk)
            most -= len(chunk)
    return digest.hexdigest()
