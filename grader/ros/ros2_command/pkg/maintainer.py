"""The default maintainer of a new package."""

import getpass
import shutil
import subprocess

from .. import distro


def default_name() -> str:
    """Return the login name, or in kilted git's ``user.name`` if it is set (ros2cli#968).

    Raises KeyError (OSError from Python 3.13 on) for a user id without name and no ``USER``.
    """
    return (distro.is_kilted() and _git("user.name")) or getpass.getuser()


def default_email(name: str) -> str:
    """Return git's ``user.email``, or a placeholder address."""
    return _git("user.email") or f"{name}@todo.todo"


def _git(key: str) -> str:
    git = shutil.which("git")
    if git is None:
        return ""
    answer = subprocess.run([git, "config", key], stdout=subprocess.PIPE, check=False)
    return answer.stdout.decode(errors="replace").rstrip()
