"""The files of the workspace, as the page's editor reads and writes them.

No link is followed, and nothing outside of the workspace is reached. A file is exchanged as a whole,
and whatever was in its place at that moment is looked at: what another program saved meanwhile is
kept beside, in `.lab/backups`.
"""

from __future__ import annotations

import contextlib
import ctypes
import errno
import hashlib
import json
import os
import secrets
import stat
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path, PurePosixPath

from grader.base.errors import UsageError
from grader.base.folder import TEMPORARY, Folder
from grader.base.i18n.message import say
from grader.base.safe_open import create_file
from grader.base.shown import shown
from lab.guide.progress import FOLDER as OWN

MOST_BYTES = 1_000_000  # of a file in the editor
MOST_FILES = 2_000
DEEPEST = 10  # folders
BUILT = {"build", "install", "log"}
"""Folders of the workspace that a build makes."""
UNLISTED = {"__pycache__", ".git", ".vscode", OWN}
DRAFTS, BACKUPS = "drafts", "backups"
NEW_FILE, NEW_FOLDER = 0o644, 0o755
NO_REPLACE, EXCHANGE = 1, 2  # of <linux/fs.h>, behind RENAME_


@dataclass(frozen=True)
class Text:
    """A file as it is: `version` is a hash of its content, "" if there is no file."""

    text: str
    version: str


@dataclass(frozen=True)
class Saved:
    """What became of a file that was saved.

    `conflict` has the file of another program that was not overwritten: nothing was written then.
    `backup` is where the file of another program is that was saved in the same moment.
    """

    version: str = ""
    conflict: Text | None = None
    backup: str = ""


def version_of(content: bytes) -> str:
    """Return the version of a content."""
    return hashlib.sha256(content).hexdigest()


class Files:
    """The files below a workspace's folder. Paths are relative to it, with slashes.

    Its methods raise UsageError for a path that is none, or a file that cannot be read or written.
    """

    def __init__(self, root: Path) -> None:
        self.root = root

    def names(self) -> list[str]:
        """Return the paths of the files, without what a build makes and without links."""
        with Folder.open(self.root) as folder:
            found = [path for _, path in zip(range(MOST_FILES), _walk(folder, "", DEEPEST))]
        return sorted(found, key=lambda path: (path.count("/") == 0, path))

    def read(self, path: str) -> Text:
        """Return a file."""
        folders, name = _parts(path)
        with _errors(path), self._inside(folders) as folder:
            content = folder.read(name)
            if content is None:
                raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT))
        return Text(_decoded(content, path), version_of(content))

    def write(self, path: str, text: str, version: str) -> Saved:
        """Replace the file if it still has this version ("": if there is none)."""
        folders, name = _parts(path)
        content = text.encode()
        if len(content) > MOST_BYTES:
            raise _too_big(path)
        with _errors(path), self._inside(folders, make=not version) as folder:
            before = folder.read(name)
            if before is None and folder.kind(name):
                raise OSError(errno.ELOOP, "it is not a regular file")
            if (version_of(before) if before is not None else "") != version:
                return Saved(conflict=_as_text(before))
            displaced = _put(folder, name, content)
        backup = ""
        if (version_of(displaced) if displaced is not None else "") != version:
            backup = self.keep(path, displaced or b"")
        return Saved(version_of(content), backup=backup)

    def keep(self, path: str, content: bytes) -> str:
        """Keep a content in `.lab/backups`, and return where."""
        moment = datetime.now(timezone.utc).strftime("%Y%m%d-%H%M%S")
        name = f"{PurePosixPath(path).name}.{moment}-{secrets.token_hex(2)}"
        with self._own(BACKUPS) as folder:
            folder.replace(name, content)
        return f"{OWN}/{BACKUPS}/{name}"

    def draft(self, path: str) -> tuple[str, str] | None:
        """Return the text of a file that was not saved, and the version that it began with."""
        with contextlib.suppress(OSError, ValueError, KeyError, TypeError):
            with self._own(DRAFTS) as folder:
                found = json.loads(folder.read(_draft_name(path)) or b"{}")
            return str(found["text"]), str(found["version"])
        return None

    def keep_draft(self, path: str, text: str | None, version: str) -> None:
        """Keep a text that is not saved; None: there is none any more."""
        _parts(path)
        with _errors(path), self._own(DRAFTS) as folder:
            if text is None:
                folder.remove(_draft_name(path))
                return
            kept = {"path": path, "version": version, "text": text}
            folder.replace(_draft_name(path), json.dumps(kept, ensure_ascii=False).encode())

    @contextlib.contextmanager
    def _own(self, name: str) -> Iterator[Folder]:
        """Open a folder of the lab's own folder in the workspace."""
        with Folder.open(self.root) as root, root.private(OWN) as own, own.private(name) as folder:
            yield folder

    @contextlib.contextmanager
    def _inside(self, folders: tuple[str, ...], *, make: bool = False) -> Iterator[Folder]:
        """Open a folder below the workspace, name by name; no name may be a link."""
        with contextlib.ExitStack() as opened:
            folder = opened.enter_context(Folder.open(self.root))
            for name in folders:
                if make and not folder.kind(name):
                    os.mkdir(name, NEW_FOLDER, dir_fd=folder.descriptor)
                folder = opened.enter_context(folder.sub(name))
            yield folder


def _draft_name(path: str) -> str:
    return f"{hashlib.sha256(path.encode()).hexdigest()[:32]}.json"


def _parts(path: str) -> tuple[tuple[str, ...], str]:
    """Return the folders and the name of a path; UsageError for one that is not of the workspace."""
    names = path.split("/")
    if any(not name or name in (".", "..") or "\0" in name for name in names) or names[0] == OWN:
        raise UsageError(
            say("{path} is no file of the workspace", path=shown(path)),
            remedy=say("Give a path like src/my_package/setup.py."),
        )
    return tuple(names[:-1]), names[-1]


def _walk(folder: Folder, place: str, depth: int) -> Iterator[str]:
    for name in folder.names():
        kind, path = folder.kind(name), f"{place}{name}"
        if kind == "file" and not name.startswith(TEMPORARY):
            yield path
        elif kind == "folder" and depth and name not in UNLISTED and path not in BUILT:
            with contextlib.suppress(OSError), folder.sub(name) as below:
                yield from _walk(below, f"{path}/", depth - 1)


def _decoded(content: bytes, path: str) -> str:
    if len(content) > MOST_BYTES:
        raise _too_big(path)
    try:
        text = content.decode()
    except UnicodeDecodeError:
        text = "\0"
    if "\0" in text:
        raise UsageError(
            say("{path} is not a text in UTF-8", path=shown(path)),
            remedy=say("The editor opens texts only."),
        )
    return text


def _as_text(content: bytes | None) -> Text:
    if content is None:
        return Text("", "")
    return Text(content.decode("utf-8", "replace"), version_of(content))


def _too_big(path: str) -> UsageError:
    return UsageError(
        say("{path} has more than {most} bytes", path=shown(path), most=MOST_BYTES),
        remedy=say("Use a program in the terminal for it."),
    )


@contextlib.contextmanager
def _errors(path: str) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        is_link = error.errno in (errno.ELOOP, errno.ENOTDIR)
        reason = say("there is a link in its path") if is_link else os.strerror(error.errno or 0)
        raise UsageError(
            say("{path} cannot be opened or saved: {reason}", path=shown(path), reason=reason),
            remedy=say("Look at it in the terminal: ls -l ~/ros2_ws/{path}", path=shown(path)),
        ) from error


def _put(folder: Folder, name: str, content: bytes) -> bytes | None:
    """Put a content in the place of a file, with its mode; return what was there at that moment."""
    inside = folder.descriptor
    temporary = f"{TEMPORARY}{secrets.token_hex(8)}"
    try:
        mode = stat.S_IMODE(os.stat(name, dir_fd=inside, follow_symlinks=False).st_mode)
    except FileNotFoundError:
        mode = NEW_FILE
    try:
        with create_file(temporary, 0o600, inside=inside) as file:
            file.write(content)
            file.flush()
            os.fchmod(file.fileno(), mode)
            os.fsync(file.fileno())
        return _exchanged(folder, temporary, name)
    finally:
        folder.remove(temporary)
        os.fsync(inside)


def _exchanged(folder: Folder, temporary: str, name: str) -> bytes | None:
    """Give a temporary file its name; return what had it at that moment, None if nothing had."""
    number = _renameat2(folder.descriptor, temporary, name, EXCHANGE)
    if number == 0:
        return folder.read(temporary)
    if number == errno.ENOENT:
        number = _renameat2(folder.descriptor, temporary, name, NO_REPLACE)
        if number == 0:
            return None
    if number in (errno.EINVAL, errno.ENOSYS):  # a file system that cannot do it in one step
        before = folder.read(name)
        os.rename(temporary, name, src_dir_fd=folder.descriptor, dst_dir_fd=folder.descriptor)
        return before
    raise OSError(number, os.strerror(number))


def _renameat2(inside: int, old: str, new: str, flag: int) -> int:
    """Rename a file of a folder as renameat2(2) does; return the number of the error, or 0."""
    libc = ctypes.CDLL(None, use_errno=True)
    done = libc.renameat2(inside, old.encode(), inside, new.encode(), flag)
    return ctypes.get_errno() if done else 0
