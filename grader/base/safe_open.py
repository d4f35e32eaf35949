"""Opens files and folders that others may replace meanwhile: the last name is never a link.

A name can be resolved in an open folder (`inside`, a descriptor; openat(2)), so that replacing a
folder of its path with a link does not redirect the access. All of them raise OSError; opening a
link gives ELOOP, or ENOTDIR if a folder was expected.
"""

from __future__ import annotations

import errno
import os
import stat
from pathlib import Path
from typing import IO

from grader.base.i18n.message import say

Name = str | Path
FOLDER = os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC
# O_NONBLOCK: opening a pipe does not wait for its writer
EXISTING = os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC
NEW = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC


class NotRegularError(OSError):
    """What was opened is a folder, a device, a pipe or a socket; `strerror` says so in words."""

    def __init__(self) -> None:
        super().__init__(errno.EINVAL, say("it is not a regular file"))


def open_folder(name: Name, *, inside: int | None = None, follows: bool = False) -> int:
    """Return the descriptor of a folder, of a link's target if it `follows`; the caller closes it."""
    return os.open(name, FOLDER if follows else FOLDER | os.O_NOFOLLOW, dir_fd=inside)


def open_file(name: Name, *, inside: int | None = None) -> IO[bytes]:
    """Open a regular file for reading; NotRegularError for anything else."""
    handle = os.open(name, EXISTING, dir_fd=inside)
    if not stat.S_ISREG(os.fstat(handle).st_mode):
        os.close(handle)
        raise NotRegularError
    return os.fdopen(handle, "rb")


def create_file(name: Name, mode: int, *, inside: int | None = None) -> IO[bytes]:
    """Create a file with a mode and open it for writing; FileExistsError if the name exists."""
    return os.fdopen(os.open(name, NEW, mode, dir_fd=inside), "wb")
