"""A member of an archive, as its reader gives it, and where its name leads."""

from __future__ import annotations

import re
from collections.abc import Callable
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime
from typing import Literal

DRIVE = re.compile(r"[A-Za-z]:[/\\]")
CHUNK = 65_536


@dataclass(frozen=True)
class Member:
    """One name in an archive: `name` as it is written there, with `/` between folders.

    `mode` is None where the archive does not record it, `modified` (no time zone: archives have
    none, or the local one) where it tells no time; `target` is where a link or a hard link leads.
    `chunks` gives a file's bytes, once, and before the next member is asked for; `remark` is a
    thing to be told about the name.
    """

    name: str
    kind: Literal["file", "folder", "link", "hard link", "special"]
    mode: int | None
    size: int = 0
    modified: datetime | None = None
    target: str = ""
    remark: str = ""
    chunks: Callable[[], Iterator[bytes]] = lambda: iter(())


def inside(name: str) -> str | None:
    """Return where a name leads below the archive's root (`.`), None if it leads out of it.

    A name leads out that is absolute, begins with a drive's letter, or goes up anywhere.
    """
    if name.startswith("/") or DRIVE.match(name):
        return None
    parts = [part for part in name.split("/") if part not in ("", ".")]
    if ".." in parts:
        return None
    return "/".join(parts) or "."
