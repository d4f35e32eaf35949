"""The grader's cache. A folder in it is made once: completely or not at all."""

from __future__ import annotations

import errno
import os
import shutil
import tempfile
from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path

from grader.base.errors import SurroundingsError
from grader.base.i18n.message import Message, msg
from grader.base.lock import locked

Notify = Callable[[str], None]
WAITING = msg("another grader is making the same prefix: waiting for it")
MORE_SPACE = msg(
    "Free some space there (a ROS prefix takes about 300 MB), or set GRADER_CACHE to a folder on "
    "another disk."
)
OTHER_FOLDER = msg("Set GRADER_CACHE to a folder that you may write to.")
FORBIDDEN = (errno.EACCES, errno.EPERM, errno.EROFS)
NOT_REMOVED = msg("{path} is damaged and cannot be removed: {reason}")
REMOVE = msg("Remove that folder, then run the command again.")


def cache_root() -> Path:
    """Return the cache folder: $GRADER_CACHE, else $XDG_CACHE_HOME/ros2_teaching_lab.

    Root's is in /var/cache, since other users in a sandbox must be able to read it.
    """
    own = os.environ.get("GRADER_CACHE")
    if own:
        return Path(own).absolute()
    base = os.environ.get("XDG_CACHE_HOME")
    if base:
        return Path(base) / "ros2_teaching_lab"
    home = Path("/var/cache") if os.geteuid() == 0 else Path.home() / ".cache"
    return home / "ros2_teaching_lab"


def make_once(folder: Path, make: Callable[[Path], None], *, notify: Notify) -> bool:
    """Make `folder` with `make(staging)` unless it exists; return whether it was made now.

    Of two callers at once, the second waits for the first. A killed one leaves a staging folder
    that the next one removes; `folder` appears by one rename, complete.
    """
    if folder.is_dir():
        return False
    old_umask = os.umask(0o022)  # other user ids inside a sandbox must be able to read it
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        with _locked(folder, notify):
            if folder.is_dir():
                return False
            for left in folder.parent.glob(f"{_unfinished(folder)}*"):
                shutil.rmtree(left, ignore_errors=True)
            staging = Path(tempfile.mkdtemp(prefix=_unfinished(folder), dir=folder.parent))
            staging.chmod(0o755)
            try:
                make(staging)
                staging.rename(folder)
            finally:
                shutil.rmtree(staging, ignore_errors=True)
    except OSError as error:
        raise SurroundingsError(
            Message(
                msg("cannot create {path}: {reason}"),
                {"path": str(folder), "reason": str(error.strerror or error)},
            ),
            remedy=Message(OTHER_FOLDER if error.errno in FORBIDDEN else MORE_SPACE),
        ) from error
    finally:
        os.umask(old_umask)
    return True


def discard(folder: Path, *, unless: Callable[[Path], bool], notify: Notify) -> None:
    """Remove a damaged folder from the cache; `unless` returns whether it is intact after all.

    Programs that still use its files keep them until the next `make_once` deletes them. Raises
    SurroundingsError if the cache cannot be written.
    """
    try:
        with _locked(folder, notify):
            if folder.is_dir() and not unless(folder):
                folder.rename(tempfile.mkdtemp(prefix=_unfinished(folder), dir=folder.parent))
    except OSError as error:
        reason = str(error.strerror or error)
        raise SurroundingsError(
            Message(NOT_REMOVED, {"path": str(folder), "reason": reason}), remedy=Message(REMOVE)
        ) from error


def _locked(folder: Path, notify: Notify) -> AbstractContextManager[None]:
    lock = folder.parent / f".{folder.name}.lock"
    return locked(lock, waiting=lambda: notify(Message(WAITING)))


def _unfinished(folder: Path) -> str:
    """Return the prefix of the names of folders that the next `make_once` deletes."""
    return f".{folder.name}.making-"
