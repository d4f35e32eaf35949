"""Files of this machine, read with limits; only regular files are read."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from grader.base import safe_open
from grader.base.i18n.message import say

MEGABYTE = 1_000_000


@dataclass(frozen=True)
class Unread:
    """Why a file has no data."""

    reason: str


def larger_than(limit: int) -> Unread:
    """Return the reason for a file beyond the limit (bytes)."""
    return Unread(say("it is larger than {size} MB", size=f"{limit / MEGABYTE:g}"))


def open_file(path: Path) -> IO[bytes] | Unread:
    """Open a regular file for reading; never follows a link, never waits."""
    try:
        return safe_open.open_file(path)
    except OSError as error:
        return _unread(error)


def read_bytes(path: Path, limit: int) -> bytes | Unread:
    """Return a regular file's bytes, at most `limit`; never follows a link, never waits."""
    opened = open_file(path)
    if isinstance(opened, Unread):
        return opened
    try:
        with opened as file:
            if os.fstat(file.fileno()).st_size > limit:
                return larger_than(limit)
            found = file.read(limit + 1)
    except OSError as error:
        return _unread(error)
    # (the limit also stops a file that grows while it is read, or reports no size)
    return larger_than(limit) if len(found) > limit else found


def _unread(error: OSError) -> Unread:
    return Unread(error.strerror or type(error).__name__)
