"""Finds or creates the student's workspace on this machine; existing files are never changed."""

from __future__ import annotations

import contextlib
import errno
import os
import pwd
import shlex
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from grader.base.errors import UsageError
from grader.base.folder import Folder
from grader.base.i18n.message import say

KEPT = ".lab"  # in the workspace: progress, backups, and the home folder; colcon skips it
STARTUP = """\
# Your own settings for the terminals of the lab. The first line sets the lab up: keep it.
. /opt/ros2_teaching_lab/lab/shell/bashrc
"""
FIRST_USER = 1000  # the first ordinary user of Debian, Ubuntu and the images


@dataclass(frozen=True)
class Student:
    """The numeric ids of the workspace's owner, never root's."""

    uid: int
    gid: int


@dataclass(frozen=True)
class Workspace:
    """A writable workspace; `path` on this machine, with links resolved."""

    path: Path
    owner: Student
    INSIDE: ClassVar[str] = "ros2_ws"

    @property
    def home(self) -> Path:
        """The folder that is the student's home folder in the lab: it is kept like the workspace."""
        return self.path / KEPT / "home"


def prepare(folder: Path | None) -> Workspace:
    """Return the workspace (default: the caller's ~/ros2_ws); create it and its `src` if missing.

    Existing files are not changed. UsageError for a path that cannot be a workspace or that the
    student cannot write to.
    """
    path = workspace_path(folder)
    try:
        path = path.resolve()
        _check_path(path)
        owner = _student(path)
        _make(path, owner)
        _make(path / "src", owner)
        for each in (path, path / "src"):
            _check_writable(each, owner)
        _make_home(Workspace(path, owner))
        _check_writable(path / KEPT / "home", owner)
    except (OSError, RuntimeError) as error:  # (RuntimeError: links in a circle, on Python 3.10)
        said = str(error.strerror if isinstance(error, OSError) else error)
        raise UsageError(
            say("the workspace {path} cannot be created: {problem}", path=str(path), problem=said),
            remedy=say("Choose a folder of your own: make lab WORKSPACE=path"),
        ) from error
    return Workspace(path, owner)


def workspace_path(folder: Path | None) -> Path:
    """Return the path of the workspace, which may not exist: a folder, or the caller's ~/ros2_ws."""
    return folder.expanduser() if folder is not None else _home() / "ros2_ws"


def _home() -> Path:
    """Return the caller's home folder; with sudo, that of the user who called it."""
    sudo_user = _sudo_user()
    if sudo_user is not None:
        try:
            return Path(pwd.getpwuid(sudo_user.uid).pw_dir)
        except KeyError:
            pass
    return Path.home()


def _sudo_user() -> Student | None:
    uid, gid = os.environ.get("SUDO_UID", ""), os.environ.get("SUDO_GID", "")
    if os.geteuid() != 0 or not (uid.isdecimal() and gid.isdecimal()) or int(uid) == 0:
        return None
    return Student(int(uid), int(gid))


def _student(path: Path) -> Student:
    """Return the user of the lab's commands: caller, user of sudo, or owner of the folder."""
    if os.geteuid() != 0:
        return Student(os.geteuid(), os.getegid())
    sudo_user = _sudo_user()
    if sudo_user is not None:
        return sudo_user
    if path.exists() and path.stat().st_uid != 0:
        return Student(path.stat().st_uid, path.stat().st_gid)
    return Student(FIRST_USER, FIRST_USER)


def _check_path(path: Path) -> None:
    """Raise UsageError for a file, the home folder or a folder above it."""
    remedy = say("Choose a folder for it: make lab WORKSPACE=~/ros2_ws")
    if path.exists() and not path.is_dir():
        raise UsageError(say("the workspace {path} is a file", path=str(path)), remedy=remedy)
    home = _home().resolve()
    if path == home:
        whole = say("{path} cannot be a workspace: it is your home folder", path=str(path))
        raise UsageError(whole, remedy=remedy)
    if path in home.parents:
        above = say("{path} cannot be a workspace: it is above your home folder", path=str(path))
        raise UsageError(above, remedy=remedy)


def _make(folder: Path, owner: Student) -> None:
    """Create a folder and its missing parents, owned by the student."""
    if folder.is_dir():
        return
    _make(folder.parent, owner)
    folder.mkdir(mode=0o755, exist_ok=True)  # (another lab may be faster)
    if os.geteuid() == 0:
        os.chown(folder, owner.uid, owner.gid)


def _make_home(workspace: Workspace) -> None:
    """Make the home folder and its .bashrc, unless the student has them already."""
    _make(workspace.path / KEPT, workspace.owner)
    if (workspace.path / KEPT).is_symlink() or workspace.home.is_symlink():
        raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))
    _make(workspace.home, workspace.owner)
    _make(workspace.home / workspace.INSIDE, workspace.owner)  # where the workspace is mounted
    with contextlib.suppress(FileExistsError), Folder.open(workspace.home) as home:
        if home.kind(".bashrc"):
            return
        home.replace(".bashrc", STARTUP.encode())
        if os.geteuid() == 0:
            uid, gid = workspace.owner.uid, workspace.owner.gid
            os.chown(workspace.home / ".bashrc", uid, gid, follow_symlinks=False)


def _check_writable(folder: Path, owner: Student) -> None:
    """Test it as the student: root can write everywhere, and mode bits are not sufficient."""
    test = ["test", "-w", ".", "-a", "-x", "."]
    root = os.geteuid() == 0
    try:
        if root:
            done = subprocess.run(
                test, cwd=folder, user=owner.uid, group=owner.gid, extra_groups=[], check=False
            )
        else:
            done = subprocess.run(test, cwd=folder, check=False)
    except PermissionError:  # the folder cannot even be entered
        done = None
    if done is None or done.returncode:
        raise UsageError(
            say(
                "the student (user id {uid}) cannot write to the workspace folder {path}",
                path=str(folder),
                uid=owner.uid,
            ),
            remedy=say(
                "Change its owner: {command}. Or choose another folder: make lab WORKSPACE=path",
                command=f"sudo chown -R {owner.uid}:{owner.gid} {shlex.quote(str(folder))}",
            ),
        )
