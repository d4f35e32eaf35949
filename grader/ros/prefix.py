"""A ROS prefix made of PyPI's wheels: no root, no Docker, one folder in the cache.

It is laid out like `/opt/ros/<distro>` of the Debian packages (`lib/pythonX.Y/site-packages` found
by PYTHONPATH, shared libraries in `lib`), not as a virtual environment: so colcon and setup.py
behave as under ROS's own, and no Python is started twice by the wheels' `.pth` file.

A folder of that name in the cache is a prefix whose programs have been seen to run: it gets its
name after that.
"""

from __future__ import annotations

import hashlib
import json
import os
import platform
import re
import shutil
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from grader.base.cache import Notify, cache_root, discard, make_once
from grader.base.errors import SurroundingsError
from grader.base.i18n.message import Message
from grader.ros import prefix_texts as texts
from grader.ros.distro import HERE, Distro
from grader.ros.making import COMMAND, SUPPLY, make_prefix

FORMAT = 2  # raise it when what `making` does changes
PYTHONS = ("3.10", "3.11", "3.12", "3.13")  # those that PyPI has ROS wheels for
PROGRAMS = ("python3", "colcon", "ros2")  # of bin: those that a verdict starts


@dataclass(frozen=True)
class Ros:
    """A ROS installation: `path` on this machine, `interpreter` the Python that it runs on."""

    distro: Distro
    kind: str  # wheels | system | image
    path: Path
    interpreter: Path
    versions: dict[str, str]

    @property
    def inside(self) -> str:
        """Where student commands see it."""
        return f"/opt/ros/{self.distro.name}"


class BrokenRosError(SurroundingsError):
    """A program of a ROS installation does not run."""


Prove = Callable[[Ros], None]
"""What starts the programs of a ROS installation and raises BrokenRosError if one does not run."""


def base_interpreter() -> Path:
    """Return the Python behind the running (virtual) environment."""
    version = f"{sys.version_info.major}.{sys.version_info.minor}"
    for name in (f"python{version}", "python3"):
        found = Path(sys.base_prefix) / "bin" / name
        if found.exists():
            return found.resolve()
    return Path(sys.executable).resolve()


def find_ros(distro: Distro, *, prove: Prove, notify: Notify = print) -> Ros:
    """Return the ROS installation for a distro; the wheels prefix is made and proven if need be.

    $GRADER_ROS chooses: `wheels`, `system` (an existing /opt/ros/<distro>) or `auto` (the system's
    if it is there). Raises SurroundingsError if neither is available.
    """
    choice = os.environ.get("GRADER_ROS", "auto")
    system = Path("/opt/ros") / distro.name
    is_wheels = (system / "wheels-prefix.json").is_file()
    is_system = (system / "setup.bash").is_file() and not is_wheels
    if choice == "system" or (choice == "auto" and is_system):
        if not is_system:
            raise SurroundingsError(
                Message(texts.NO_ROS, {"distro": distro.name, "path": str(system)}),
                remedy=Message(texts.INSTALL),
            )
        python = Path("/usr/bin/python3").resolve()
        return Ros(distro, "system", system, python, _system_versions(system))
    # a link is the `account` sandbox's, which removes it again
    if choice in ("auto", "wheels") and is_wheels and not system.is_symlink():
        return _wheels(distro, system, (system / "bin" / "python3").resolve())  # an image of ours
    return _wheels(distro, wheels_prefix(distro, prove=prove, notify=notify), base_interpreter())


def prefix_path(distro: Distro) -> Path:
    """Return where the wheels prefix of a distro is, made or not: keyed by all that it is made of."""
    python = ".".join(platform.python_version_tuple()[:2])
    if distro.lock is None:
        raise SurroundingsError(
            Message(texts.NO_WHEELS, {"distro": distro.name}),
            remedy=Message(texts.OTHER_DISTRO, {"distro": distro.name}),
        )
    if platform.machine() != "x86_64" or sys.platform != "linux" or python not in PYTHONS:
        raise SurroundingsError(
            Message(
                texts.OTHER_PLATFORM,
                {
                    "versions": ", ".join(PYTHONS),
                    "system": f"{sys.platform} {platform.machine()}",
                    "python": python,
                },
            ),
            remedy=Message(texts.OTHER_PYTHON),
        )
    key = hashlib.sha256(b"%d " % FORMAT + os.fsencode(base_interpreter()))
    key.update(distro.lock.read_bytes())
    key.update((HERE / "setup.bash.in").read_bytes())
    for source in sorted(COMMAND.rglob("*")):
        if source.is_file() and source.suffix != ".pyc":
            key.update(str(source.relative_to(COMMAND)).encode() + source.read_bytes())
    tag = f"cp{python.replace('.', '')}-{platform.machine()}"
    return _prefixes() / f"{distro.name}-{tag}-{key.hexdigest()[:16]}"


def wheels_prefix(distro: Distro, *, prove: Prove, notify: Notify = print) -> Path:
    """Return the wheels prefix of a distro, made and proven now if it is not in the cache.

    Raises BrokenRosError if a program of it does not run, however often it is made.
    """
    folder = prefix_path(distro)
    if folder.is_dir() and not _is_whole(folder):
        discard(folder, unless=_is_whole, notify=notify)
    if not folder.is_dir():
        notify(Message(texts.MAKING, {"distro": distro.name}))
        make_once(folder, lambda staging: _make(distro, staging, prove, notify), notify=notify)
        notify(Message(texts.READY, {"distro": distro.name, "path": str(folder)}))
    return folder


def is_in_cache(ros: Ros) -> bool:
    """Whether a ROS installation was made by the grader, which can make it again."""
    return ros.path.parent == _prefixes()


def _prefixes() -> Path:
    return cache_root() / "prefixes"


def _is_whole(folder: Path) -> bool:
    """Whether the programs are there (the Python behind them may have been removed)."""
    return all(os.access(folder / "bin" / name, os.X_OK) for name in PROGRAMS)


def _make(distro: Distro, staging: Path, prove: Prove, notify: Notify) -> None:
    try:
        _make_proven(distro, staging, prove, notify)
    except BrokenRosError as broken:
        notify(Message(texts.MAKING_AGAIN, {"reason": broken.message}))
        for entry in staging.iterdir():
            if entry.is_dir() and not entry.is_symlink():
                shutil.rmtree(entry)
            else:
                entry.unlink()
        _make_proven(distro, staging, prove, notify)


def _make_proven(distro: Distro, staging: Path, prove: Prove, notify: Notify) -> None:
    interpreter = base_interpreter()
    make_prefix(distro, staging, interpreter, notify=notify)
    prove(_wheels(distro, staging, interpreter))


def _wheels(distro: Distro, path: Path, interpreter: Path) -> Ros:
    versions = json.loads((path / "wheels-prefix.json").read_text(encoding="utf-8"))
    return Ros(distro, "wheels", path, interpreter, versions)


def _system_versions(system: Path) -> dict[str, str]:
    versions = dict.fromkeys(SUPPLY, "")
    manifest = system / "share" / "rclpy" / "package.xml"
    if manifest.is_file():
        match = re.search(
            r"<version>\s*([\d.]+)\s*</version>", manifest.read_text(encoding="utf-8")
        )
        versions["rclpy"] = match.group(1) if match else ""
    versions["rmw"] = "rmw_fastrtps_cpp"
    return versions
