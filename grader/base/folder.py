"""An open folder in which no link is followed and each file is replaced as a whole.

Names are resolved against the open folder, never as a path from the root, so replacing a folder or
file with a link at the same time does not redirect access.
"""

from __future__ import annotations

import contextlib
import errno
import os
import secrets
import stat
from pathlib import Path
from types import TracebackType

from grader.base.lock import lock_open
from grader.base.safe_open import create_file, open_file, open_folder

FOLDER_MODE = 0o700
FILE_MODE = 0o600
TEMPORARY = ".unfinished-"  # a killed writer leaves files with this prefix


class Folder:
    """An open folder; close it (or use it as a context manager). Its methods raise OSError.

    `replace` returns when the file is on the disk, unless the folder is not `durable`: then a
    caller that writes many files syncs once, at the end.
    """

    def __init__(self, fd: int, path: Path, *, durable: bool = True) -> None:
        self._fd = fd
        self.path = path
        self._durable = durable

    @classmethod
    def open(cls, path: Path, *, durable: bool = True) -> Folder:
        """Open a folder that a user named; a link is followed here, since the user chose it."""
        return cls(open_folder(path, follows=True), path, durable=durable)

    def __enter__(self) -> Folder:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        os.close(self._fd)

    @property
    def descriptor(self) -> int:
        """The descriptor of the open folder, in which names are resolved."""
        return self._fd

    def lock(self) -> bool:
        """Wait for the lock, and hold it until the folder is closed.

        Return whether there is a lock: some network file systems have none.
        """
        try:
            lock_open(self._fd)
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
        """Return the names in the folder, sorted."""
        return sorted(os.listdir(self._fd))  # noqa: PTH208 - it is a descriptor

    def sub(self, name: str) -> Folder:
        """Open a folder in this one; OSError (ELOOP, ENOTDIR) if it is a link."""
        return Folder(open_folder(name, inside=self._fd), self.path / name, durable=self._durable)

    def private(self, name: str) -> Folder:
        """Open a folder in this one for its owner only; it is created if it is missing."""
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
        """Remove all permissions of group and others, if the file system has permissions."""
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
        try:
            file = open_file(name, inside=self._fd)
        except OSError:
            return None
        with file:
            return file.read()

    def remove(self, name: str) -> None:
        """Remove a file, if it exists; of a link, the link itself."""
        with contextlib.suppress(FileNotFoundError):
            os.unlink(name, dir_fd=self._fd)

    def replace(self, name: str, content: bytes) -> None:
        """Replace the file `name`: at each moment it is the old one or the new one.

        Only its owner can read it.
        """
        temporary = f"{TEMPORARY}{secrets.token_hex(8)}"
        new = create_file(temporary, FILE_MODE, inside=self._fd)
        try:
            with new as file:
                file.write(content)
                file.flush()
                if self._durable:
                    os.fsync(file.fileno())
            os.rename(temporary, name, src_dir_fd=self._fd, dst_dir_fd=self._fd)
        except BaseException:
            with contextlib.suppress(OSError):
                os.unlink(temporary, dir_fd=self._fd)
            raise
        self._sync()

    def sweep(self) -> None:
        """Remove the files of killed writers; call it only while holding the lock."""
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
            # some file systems cannot sync a folder
            if error.errno not in (errno.EINVAL, errno.EBADF, errno.ENOTSUP):
                raise
