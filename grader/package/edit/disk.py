"""Write changed files to the student's own copy: all or nothing, and never outside the package.

Every folder of a path is opened without following links (`safe_open`), so no link in the package
leads out of it, not even one that is created during the write. A new file is written next to the
old one and renamed over it; the old bytes stay in `<name>.~1~`, a backup as `cp --backup=numbered`
makes it (intake leaves such files out).
"""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.i18n.message import joined, say
from grader.base.safe_open import create_file, open_file, open_folder
from grader.base.shown import shown
from grader.package.edit.files import Files
from grader.package.intake.model import SourceFile

MOST_BACKUPS = 1000
NOTHING_WRITTEN = say("Nothing was written.")
IS_NEW = say("it did not exist when the package was read")
IS_LINK = say("it is a link, and only regular files are fixed")
BEHIND_LINK = say("a folder in its path is a link")
IS_CHANGED = say("it has changed since the package was read; run grader fix again")
IS_READ_ONLY = say("it is read-only (make it writable with: chmod u+w)")


@dataclass(frozen=True)
class Change:
    """One file to change: its old path and content, and its new path and content."""

    source: str | None
    before: SourceFile | None
    path: str
    after: SourceFile


@dataclass
class _Begun:
    """A change that was begun, and the path of its backup once the file is replaced."""

    change: Change
    backup: str = ""


def changes(old: Files, new: Files) -> list[Change]:
    """Return the files that differ."""
    found = []
    for path, after in sorted(new.by_path.items()):
        source = new.moved.get(path, path)
        before = old.by_path.get(source)
        same = before is not None and (before.data, before.mode) == (after.data, after.mode)
        if after.kind == "file" and not (same and source == path):
            found.append(Change(source if before else None, before, path, after))
    return found


def apply(old: Files, new: Files, root: Path) -> list[str]:
    """Write the new files to the package in the folder `root` and return the backups' paths in it.

    Raises UsageError if a file is read-only, is a link, or has changed since it was read: then
    nothing is written. If a write fails, the old files are restored, or the error names those
    that could not be.
    """
    todo = changes(old, new)
    begun: list[_Begun] = []
    with _package(root) as top:
        for change in todo:
            _check(top, change)
        try:
            for change in todo:
                begun.append(_Begun(change))
                _write(top, begun[-1])
        except OSError as error:
            lost = _undo(top, begun)
            reason = error.strerror or str(error)
            raise _refused(begun[-1].change.path, reason, not_restored=lost) from None
        except BaseException:  # Ctrl+C leaves no partial change
            _undo(top, begun)
            raise
    return [one.backup for one in begun if one.backup]


def _refused(path: str, reason: str, *, not_restored: Sequence[str] = ()) -> UsageError:
    remedy = NOTHING_WRITTEN
    if not_restored:
        paths = ", ".join(shown(path) for path in not_restored)
        remedy = say("These files could not be restored, check them: {paths}.", paths=paths)
    return UsageError(joined(shown(path), reason, by=": "), remedy=remedy)


@contextmanager
def _package(root: Path) -> Iterator[int]:
    try:
        top = open_folder(root)
    except OSError as error:
        raise _refused(str(root), error.strerror or say("it cannot be opened")) from None
    try:
        yield top
    finally:
        os.close(top)


@contextmanager
def _folder_of(top: int, path: str, *, make: bool = False) -> Iterator[tuple[int, str]]:
    """Open the folder of a path in the package and yield it with the file's name."""
    *above, name = path.split("/")
    at = os.dup(top)
    try:
        for part in above:
            if part in ("", ".", ".."):
                raise OSError(errno.EINVAL, say("it is not a path in the package"))
            if make:
                with suppress(FileExistsError):
                    os.mkdir(part, dir_fd=at)
            inner = open_folder(part, inside=at)
            os.close(at)
            at = inner
        yield at, name
    finally:
        os.close(at)


def _check(top: int, change: Change) -> None:
    """Raise UsageError if a change is not allowed."""
    if change.source != change.path and _is_there(top, change.path):
        raise _refused(change.path, IS_NEW)
    if change.source is None or change.before is None:
        return
    try:
        with _folder_of(top, change.source) as (folder, name):
            mode = os.stat(name, dir_fd=folder, follow_symlinks=False).st_mode
            if stat.S_ISLNK(mode):
                raise _refused(change.source, IS_LINK)
            found = _bytes(folder, name, len(change.before.data))
    except OSError as error:
        what = BEHIND_LINK if error.errno == errno.ELOOP else error.strerror
        raise _refused(change.source, what or say("it cannot be read")) from None
    if found != change.before.data:
        raise _refused(change.source, IS_CHANGED)
    if not mode & stat.S_IWUSR:
        raise _refused(change.source, IS_READ_ONLY)


def _bytes(folder: int, name: str, expected: int) -> bytes:
    with open_file(name, inside=folder) as file:
        return file.read(expected + 1)


def _is_there(top: int, path: str) -> bool:
    try:
        with _folder_of(top, path) as (folder, name):
            os.stat(name, dir_fd=folder, follow_symlinks=False)
    except FileNotFoundError:
        return False
    except OSError as error:
        what = BEHIND_LINK if error.errno in (errno.ELOOP, errno.ENOTDIR) else ""
        raise _refused(path, what or error.strerror or say("it cannot be accessed")) from None
    return True


def _write(top: int, begun: _Begun) -> None:
    """Make one change, and note the path of its backup if it needs one."""
    change, backup = begun.change, ""
    if change.source is not None and change.source != change.path:
        _move(top, change.source, change.path)
    with _folder_of(top, change.path, make=True) as (folder, name):
        before = change.before
        if before is None or before.data != change.after.data:
            old = os.stat(name, dir_fd=folder) if before is not None else None
            temporary = f".{name}.{os.getpid()}.new~"
            _put(folder, temporary, change.after.data, old)
            try:
                if before is not None:
                    backup = _backed_up(folder, name)
                os.rename(temporary, name, src_dir_fd=folder, dst_dir_fd=folder)
            except BaseException:
                for left in filter(None, (temporary, backup)):
                    os.unlink(left, dir_fd=folder)
                raise
            above = change.path.rpartition("/")[0]
            begun.backup = f"{above}/{backup}".lstrip("/") if backup else ""
        if before is not None and before.mode != change.after.mode:
            _chmod(folder, name, change.after.mode)


def _chmod(folder: int, name: str, mode: int) -> None:
    with open_file(name, inside=folder) as file:
        os.fchmod(file.fileno(), mode & 0o777)


def _move(top: int, source: str, path: str) -> None:
    with (
        _folder_of(top, source) as (old, name),
        _folder_of(top, path, make=True) as (new, to),
    ):
        os.rename(name, to, src_dir_fd=old, dst_dir_fd=new)


def _put(folder: int, name: str, found: bytes, like: os.stat_result | None) -> None:
    """Write a new file with the mode and, if allowed, the owner of `like`."""
    with create_file(name, 0o644, inside=folder) as file:
        file.write(found)
        file.flush()
        like = like or os.fstat(folder)
        with suppress(PermissionError):  # (a file system without modes refuses them)
            if stat.S_ISREG(like.st_mode):
                os.fchmod(file.fileno(), stat.S_IMODE(like.st_mode))
            os.fchown(file.fileno(), like.st_uid, like.st_gid)
        os.fsync(file.fileno())


def _backed_up(folder: int, name: str) -> str:
    """Keep a file under a second name: a hard link, or a copy if links are not supported."""
    for number in range(1, MOST_BACKUPS + 1):
        backup = f"{name}.~{number}~"
        try:
            os.link(name, backup, src_dir_fd=folder, dst_dir_fd=folder, follow_symlinks=False)
        except FileExistsError:
            continue
        except OSError:
            try:
                old = os.stat(name, dir_fd=folder, follow_symlinks=False)
                _put(folder, backup, _bytes(folder, name, old.st_size), old)
            except FileExistsError:
                continue
        return backup
    raise OSError(errno.EEXIST, say("there are {count} backups of it already", count=MOST_BACKUPS))


def _undo(top: int, begun: Sequence[_Begun]) -> list[str]:
    """Restore the old files, the last change first; return the paths that could not be restored."""
    lost = []
    for one in reversed(begun):
        change = one.change
        try:
            _restore(top, change, one.backup)
        except FileNotFoundError:
            if one.backup:  # without one, the change had not reached the file
                lost.append(change.path)
        except OSError:
            lost.append(change.path)
        if change.source is not None and change.source != change.path:
            try:
                _move(top, change.path, change.source)
            except FileNotFoundError:  # it had not been moved
                pass
            except OSError:
                lost.append(change.path)
    return list(dict.fromkeys(lost))


def _restore(top: int, change: Change, backup: str) -> None:
    with _folder_of(top, change.path) as (folder, name):
        if backup:
            os.rename(backup.rpartition("/")[2], name, src_dir_fd=folder, dst_dir_fd=folder)
        elif change.before is None:
            os.unlink(name, dir_fd=folder)
        if change.before is not None:
            _chmod(folder, name, change.before.mode)
