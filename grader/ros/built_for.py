"""For which ROS a workspace was built, from the files that the build itself has written.

A workspace outlives the lab in which it was built: opened on another base or distro, its scripts name
a Python that is not there. `python built_for.py INSTALL DISTRO` prints nothing if all is well, else in three
lines `other`, the ROS of the build and the one here, or `gone`, a script and the Python that it names.
It uses only the standard library.
"""

from __future__ import annotations

import os
import re
import shutil
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path("/opt/ros")
CHAINED = re.compile(r"/opt/ros/([a-z]{1,20})\b")
PYTHON = re.compile(r'^ *_colcon_python_executable="(/[^"$]{1,300})"', re.MULTILINE)
VERSION = re.compile(r"lib/python(3\.\d{1,2})$")
MOST = 2_000  # scripts that are read
LONGEST = 512  # bytes of a first line


@dataclass(frozen=True)
class Built:
    """A ROS: its distro, `wheels` or `ros`, and Python's version; what is unknown is ""."""

    distro: str = ""
    kind: str = ""
    python: str = ""

    def __str__(self) -> str:
        wheels = " (wheels)" if self.kind == "wheels" else ""
        return f"ROS 2 {self.distro or '?'}{wheels}, Python {self.python or '?'}"


@dataclass(frozen=True)
class Change:
    """What a workspace was built for and what is here now; a `script` names a Python that is gone."""

    was: Built
    now: Built
    script: Path | None = None
    python: str = ""


def change(install: Path, distro: str, *, root: Path = ROOT) -> Change | None:
    """Return what is different from the ROS here; None if it is what the workspace was built for."""
    now = here(distro, root=root)
    was = built_for(install, now)
    if was is None:
        return None
    script = next(scripts_without_python(install), None)
    same = all(a == b or not a or not b for a, b in zip(_fields(was), _fields(now)))
    if same and script is None:
        return None
    return Change(was, now, script, missing_python(script) if script is not None else "")


def here(distro: str, *, root: Path = ROOT) -> Built:
    """Return the ROS that is at /opt/ros/<distro>."""
    prefix = root / distro
    kind = "wheels" if (prefix / "bin" / "python3").exists() else "ros"
    versions = _versions(prefix) | _versions(prefix / "local")
    return Built(distro, kind, max(versions, key=len, default=""))


def built_for(install: Path, now: Built) -> Built | None:
    """Return the ROS for which a workspace was built; None if it is not built.

    A folder can have two Pythons, from two builds: this one's counts.
    """
    texts = [_read(install / name) for name in ("setup.sh", "local_setup.sh")]
    if not any(texts):
        return None
    distros = CHAINED.findall(texts[0])
    named = PYTHON.search(texts[1])
    kind = "" if named is None else "wheels" if named.group(1).startswith("/opt/ros/") else "ros"
    other = ""
    for folder in [install, *(path for path in sorted(install.glob("*")) if path.is_dir())]:
        versions = _versions(folder)
        if versions and now.python not in versions:
            other = max(versions, key=len)
    return Built(distros[0] if distros else "", kind, other or now.python)


def scripts_without_python(install: Path) -> Iterator[Path]:
    """Yield the installed executables whose first line names a program that is not here."""
    for number, path in enumerate(
        sorted(install.glob("*/lib/*/*")) + sorted(install.glob("lib/*/*"))
    ):
        if number == MOST:
            return
        if missing_python(path):
            yield path


def missing_python(script: Path) -> str:
    """Return the program of a script's first line if it is not here, else ""."""
    try:
        if not os.access(script, os.X_OK) or not script.is_file():
            return ""
        with script.open("rb") as file:
            line = file.readline(LONGEST).decode("utf-8", "replace")
    except OSError:
        return ""
    words = line[2:].split() if line.startswith("#!") else []
    if words and words[0].endswith("/env"):
        words = [word for word in words[1:] if not word.startswith("-") and "=" not in word]
        return words[0] if words and shutil.which(words[0]) is None else ""
    return words[0] if words and not Path(words[0]).exists() else ""


def _fields(built: Built) -> tuple[str, str, str]:
    return built.distro, built.kind, built.python


def _versions(folder: Path) -> set[str]:
    found = (VERSION.search(str(path)) for path in folder.glob("lib/python3.*"))
    return {match.group(1) for match in found if match is not None}


def _read(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""


if __name__ == "__main__":
    found = change(Path(sys.argv[1]), sys.argv[2])
    if found is not None and found.was != found.now:
        print("other", found.was, found.now, sep="\n")
    elif found is not None:
        print("gone", found.script, found.python, sep="\n")
