"""A folder held open, in which no link is followed and each file is replaced as a whole.

Names are resolved against the open folder and never as a path from the root: what somebody puts in
the place of a folder or file meanwhile leads nowhere else.
"""

from __future__ import annotations

import contextlib
import errno
import fcntl
import os
import secrets
import stat
from pathlib import Path
from types import TracebackType

FOLDER_MODE = 0o700
FILE_MODE = 0o600
OPEN_FOLDER = os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC
TEMPORARY = ".unfinished-"  # what begins so was left by a writer that was killed


class Folder:
    """An open folder; close it (or use it as a context manager). Its methods raise OSError.

    A file that was replaced in it is on the disk when that returns, unless it is not `durable`:
    then whoever writes many sees to it once, at the end.
    """

    def __init__(self, fd: int, path: Path, *, durable: bool = True) -> None:
        self._fd = fd
        self.path = path
        self._durable = durable

    @classmethod
    def open(cls, path: Path, *, durable: bool = True) -> Folder:
        """Open a folder that a user named: here a link is followed, the user meant it."""
        return cls(os.open(path, OPEN_FOLDER), path, durable=durable)

    def __enter__(self) -> Folder:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        os.close(self._fd)

    def lock(self) -> bool:
        """Wait until nobody else holds the lock, and hold it until it is closed.

        Return whether there is a lock: some network file systems have none.
        """
        try:
            fcntl.flock(self._fd, fcntl.LOCK_EX)
        except OSError:
            return False
        return True

    def kind(self, name: str) -> str:
        """Return `folder`, `file`, `link`, `other`, or "" if there is nothing of this name."""
        try:
            mode = os.stat(name, dir_fd=self._fd, follow_symlinks=False).st_mode
        except FileNotFoundError:
            return ""
        kinds = {stat.S_IFDIR: "folder", stat.S_IFREG: "file", stat.S_IFLNK: "link"}
        return kinds.get(stat.S_IFMT(mode), "other")

    def names(self) -> list[str]:
        """Return what is in the folder, sorted."""
        return sorted(os.listdir(self._fd))  # noqa: PTH208 - it is a descriptor

    def sub(self, name: str) -> Folder:
        """Open a folder in this one; OSError (ELOOP, ENOTDIR) if it is a link."""
        fd = os.open(name, OPEN_FOLDER | os.O_NOFOLLOW, dir_fd=self._fd)
        return Folder(fd, self.path / name, durable=self._durable)

    def private(self, name: str) -> Folder:
        """Open a folder in this one for its owner only, made if it is not there."""
        with contextlib.suppress(FileExistsError):
            os.mkdir(name, FOLDER_MODE, dir_fd=self._fd)
        folder = self.sub(name)
        try:
            folder.close_to_others()
        except BaseException:
            os.close(folder._fd)
            raise
        return folder

    def close_to_others(self) -> None:
        """Take every right from group and others, where the file system knows of rights."""
        found = os.fstat(self._fd)
        if stat.S_IMODE(found.st_mode) == FOLDER_MODE:
            return
        try:
            os.fchmod(self._fd, FOLDER_MODE)
        except PermissionError:
            if found.st_uid != os.geteuid():
                raise

    def read(self, name: str) -> bytes | None:
        """Return the content of a regular file; None for anything else (links are not followed)."""
        flags = os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC
        try:
            fd = os.open(name, flags, dir_fd=self._fd)
        except OSError:
            return None
        with open(fd, "rb") as file:  # noqa: PTH123 - it is a descriptor
            return file.read() if stat.S_ISREG(os.fstat(fd).st_mode) else None

    def remove(self, name: str) -> None:
        """Remove a file, if it is there; of a link it is the link that goes."""
        with contextlib.suppress(FileNotFoundError):
            os.unlink(name, dir_fd=self._fd)

    def replace(self, name: str, content: bytes) -> None:
        """Put a file in the place of `name`: at each moment there is the old one or the new one.

        It is readable by its owner only.
        """
        temporary = f"{TEMPORARY}{secrets.token_hex(8)}"
        flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC
        fd = os.open(temporary, flags, FILE_MODE, dir_fd=self._fd)
        try:
            with open(fd, "wb") as file:  # noqa: PTH123 - it is a descriptor
                file.write(content)
                file.flush()
                if self._durable:
                    os.fsync(fd)
            os.rename(temporary, name, src_dir_fd=self._fd, dst_dir_fd=self._fd)
        except BaseException:
            with contextlib.suppress(OSError):
                os.unlink(temporary, dir_fd=self._fd)
            raise
        self._sync()

    def sweep(self) -> None:
        """Remove what writers left that were killed; only for who holds the lock."""
        for name in self.names():
            if name.startswith(TEMPORARY):
                with contextlib.suppress(OSError):
                    os.unlink(name, dir_fd=self._fd)

    def _sync(self) -> None:
        if not self._durable:
            return
        try:
            os.fsync(self._fd)
        except OSError as error:
            if error.errno not in (errno.EINVAL, errno.EBADF, errno.ENOTSUP):  # not for folders
                raise
