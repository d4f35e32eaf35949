"""The student's workspace on this machine: found or made, theirs, and never overwritten."""

from __future__ import annotations

import os
import pwd
import subprocess
from dataclasses import dataclass
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.i18n.message import say

FIRST_USER = 1000  # the first ordinary user of Debian, Ubuntu and the images


@dataclass(frozen=True)
class Student:
    """Whose files these are: numeric ids, never root's."""

    uid: int
    gid: int


@dataclass(frozen=True)
class Workspace:
    """A workspace that is there and can be written: `path` on this machine, without links."""

    path: Path
    owner: Student


def prepare(asked: Path | None) -> Workspace:
    """Return the workspace (default: ~/ros2_ws of the caller), made with `src` if need be.

    What is in it stays as it is. UsageError for a path that can be no workspace, or that its
    student could not write to.
    """
    path = asked.expanduser() if asked is not None else _home() / "ros2_ws"
    try:
        path = path.resolve()
        _refuse_what_is_none(path)
        owner = _student(path)
        _make(path, owner)
        _make(path / "src", owner)
    except (OSError, RuntimeError) as error:  # (RuntimeError: links in a circle, on Python 3.10)
        said = str(error.strerror if isinstance(error, OSError) else error)
        raise UsageError(
            say("the workspace {path} cannot be made: {problem}", path=str(path), problem=said),
            remedy=say("Name a folder of yours: make lab WORKSPACE=path"),
        ) from error
    for folder in (path, path / "src"):
        _must_be_writable(folder, owner)
    return Workspace(path, owner)


def _home() -> Path:
    """Return the home of the person who called: behind sudo it is not root's."""
    behind = _sudo()
    if behind is not None:
        try:
            return Path(pwd.getpwuid(behind.uid).pw_dir)
        except KeyError:
            pass
    return Path.home()


def _sudo() -> Student | None:
    uid, gid = os.environ.get("SUDO_UID", ""), os.environ.get("SUDO_GID", "")
    if os.geteuid() != 0 or not (uid.isdecimal() and gid.isdecimal()) or int(uid) == 0:
        return None
    return Student(int(uid), int(gid))


def _student(path: Path) -> Student:
    """Return who the lab's commands run as: the caller, the one behind sudo, or the owner."""
    if os.geteuid() != 0:
        return Student(os.geteuid(), os.getegid())
    behind = _sudo()
    if behind is not None:
        return behind
    if path.exists() and path.stat().st_uid != 0:
        return Student(path.stat().st_uid, path.stat().st_gid)
    return Student(FIRST_USER, FIRST_USER)


def _refuse_what_is_none(path: Path) -> None:
    remedy = say("Name a folder for it: make lab WORKSPACE=~/ros2_ws")
    if path.exists() and not path.is_dir():
        raise UsageError(say("the workspace {path} is a file", path=str(path)), remedy=remedy)
    home = _home().resolve()
    if path == home:
        whole = say("{path} is no workspace: it is your whole home folder", path=str(path))
        raise UsageError(whole, remedy=remedy)
    if path in home.parents:
        above = say("{path} is no workspace: it is above your home folder", path=str(path))
        raise UsageError(above, remedy=remedy)


def _make(folder: Path, owner: Student) -> None:
    """Make a folder, and those above it that are missing, as the student's own."""
    if folder.is_dir():
        return
    _make(folder.parent, owner)
    folder.mkdir(mode=0o755, exist_ok=True)  # (another lab may be faster)
    if os.geteuid() == 0:
        os.chown(folder, owner.uid, owner.gid)


def _must_be_writable(folder: Path, owner: Student) -> None:
    """Try it as the student: root may write everywhere, and mode bits do not tell all."""
    test = ["test", "-w", ".", "-a", "-x", "."]
    root = os.geteuid() == 0
    try:
        if root:
            done = subprocess.run(
                test, cwd=folder, user=owner.uid, group=owner.gid, extra_groups=[], check=False
            )
        else:
            done = subprocess.run(test, cwd=folder, check=False)
    except PermissionError:  # not even entered
        done = None
    if done is None or done.returncode:
        raise UsageError(
            say(
                "the workspace's folder {path} cannot be written by its student (user id {uid})",
                path=str(folder),
                uid=owner.uid,
            ),
            remedy=say(
                "Make it theirs (sudo chown -R {uid}:{gid} …), or name another folder: make lab "
                "WORKSPACE=path",
                uid=owner.uid,
                gid=owner.gid,
            ),
        )
