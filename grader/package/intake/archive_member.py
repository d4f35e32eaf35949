"""What the readers of tar and zip share: a member of an archive, and a file with limited reads."""

from __future__ import annotations

import io
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import datetime
from typing import IO, Literal

DRIVE = re.compile(r"[A-Za-z]:[/\\]")
CHUNK = 65_536


@dataclass(frozen=True)
class Member:
    """One name in an archive: `name` as it is written there, with `/` between folders.

    `mode` is None if the archive does not record it, `modified` if it records no valid time (UTC
    in a tar, without a time zone in a zip); `target` is where a link or a hard link leads.
    `chunks` yields a file's bytes, once, and only before the next member is requested; `remark`
    is a note about the name.
    """

    name: str
    kind: Literal["file", "folder", "link", "hard link", "special"]
    mode: int | None
    size: int = 0
    modified: datetime | None = None
    target: str = ""
    remark: str = ""
    chunks: Callable[[], Iterator[bytes]] = lambda: iter(())


class LimitedFile(io.RawIOBase):
    """A seekable file whose reads a subclass limits, because a hostile header asks for gigabytes."""

    def __init__(self, file: IO[bytes]) -> None:
        self.file = file

    def seekable(self) -> bool:
        """Return True, as tarfile and zipfile require."""
        return True

    def readable(self) -> bool:
        """Return True, as tarfile and zipfile require."""
        return True

    def seek(self, offset: int, whence: int = io.SEEK_SET) -> int:
        """Move to a position of the file; return it."""
        return self.file.seek(offset, whence)

    def tell(self) -> int:
        """Return the position in the file."""
        return self.file.tell()


def inside(name: str) -> str | None:
    """Return where a name leads below the archive's root (`.`), None if it leads out of it.

    A name leads out if it is absolute, begins with a drive letter, or contains `..`.
    """
    if name.startswith("/") or DRIVE.match(name):
        return None
    parts = [part for part in name.split("/") if part not in ("", ".")]
    if ".." in parts:
        return None
    return "/".join(parts) or "."
