"""The source of a submission's files: a folder of this machine, or an archive in memory."""

# ruff: noqa: D102 - Place documents the methods

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Literal, Protocol

from grader.package.intake.modes import keeps_modes
from grader.package.intake.reading import Unread, open_file, read_bytes


@dataclass(frozen=True)
class Entry:
    """A name in the tree: `path` relative to its root; `size` in bytes, `target` of a link.

    `modified` is in seconds since 1970; 0 if it is unknown.
    """

    path: str
    kind: Literal["file", "folder", "link"]
    mode: int
    size: int = 0
    target: str = ""
    modified: float = 0


class Place(Protocol):
    """What intake reads. Paths are relative to its root (`.`), with `/` between names.

    Nothing in it is run, and no link is followed.
    """

    @property
    def name(self) -> str:
        """The name of the place itself."""

    def origin(self, path: str) -> Literal["directory", "zip", "tar"]:
        """Return the kind of source that contains a path."""

    def names(self, folder: str) -> Iterable[str]:
        """Return the names in a folder, one at a time; OSError if it cannot be read."""

    def entry(self, path: str) -> Entry | None:
        """Return the entry at a path; None for a device, pipe or socket. Raises OSError."""

    def read(self, path: str, limit: int) -> bytes | Unread:
        """Return a file's bytes, at most `limit`, or why there are none."""

    def open(self, path: str) -> IO[bytes] | Unread:
        """Return a file open for reading, or why it cannot be opened."""

    def records_modes(self, path: str) -> bool:
        """Whether the exec bit of a path is the one that the student set."""

    def remarks(self) -> Iterable[tuple[str, str]]:
        """Return what was left out when the place was made: the reason and the path of each."""


class Folder:
    """A folder of this machine; `modes_kept` is False if its files lost their modes on the way."""

    def __init__(self, root: Path, *, modes_kept: bool = True) -> None:
        self.root = root
        self.name = root.name
        self._records = modes_kept and keeps_modes(root)

    def origin(self, path: str) -> Literal["directory", "zip", "tar"]:
        del path
        return "directory"

    def names(self, folder: str) -> Iterator[str]:
        with os.scandir(self._at(folder)) as entries:
            for entry in entries:
                yield entry.name

    def entry(self, path: str) -> Entry | None:
        place = self._at(path)
        status = os.lstat(place)
        mode = stat.S_IMODE(status.st_mode)
        if stat.S_ISLNK(status.st_mode):
            return Entry(path, "link", mode, target=os.readlink(place))  # noqa: PTH115
        if stat.S_ISDIR(status.st_mode):
            return Entry(path, "folder", mode)
        if stat.S_ISREG(status.st_mode):
            return Entry(path, "file", mode, size=status.st_size, modified=status.st_mtime)
        return None

    def read(self, path: str, limit: int) -> bytes | Unread:
        return read_bytes(self._at(path), limit)

    def open(self, path: str) -> IO[bytes] | Unread:
        return open_file(self._at(path))

    def records_modes(self, path: str) -> bool:
        del path
        return self._records

    def remarks(self) -> Iterable[tuple[str, str]]:
        return ()

    def _at(self, path: str) -> Path:
        return self.root if path == "." else self.root / path


def not_a_folder(path: str) -> OSError:
    """Return the error that a folder of this machine would give."""
    return NotADirectoryError(errno.ENOTDIR, os.strerror(errno.ENOTDIR), path)


def not_there(path: str) -> OSError:
    """Return the error that a folder of this machine would give."""
    return FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), path)
