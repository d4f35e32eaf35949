"""ROS installations: the system's, or a prefix made from PyPI's wheels without root and Docker.

The wheels prefix has the layout of `/opt/ros/<distro>` in the Debian packages
(`lib/pythonX.Y/site-packages` on PYTHONPATH, shared libraries in `lib`) instead of a virtual
environment's: colcon and setup.py behave as with the Debian packages, and the wheels' `.pth` file
does not start Python twice.

A prefix gets its name in the cache only after its programs have run once.
"""

from __future__ import annotations

import hashlib
import json
import os
import platform
import re
import shutil
import sys
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from grader.base.cache import Notify, cache_root, discard, make_once
from grader.base.errors import SurroundingsError
from grader.base.i18n.message import Message, joined, msg, say
from grader.ros.distro import HERE, Distro
from grader.ros.prefix_build import COMMAND, make_prefix
from grader.ros.wheels_tree import VERSION_NAMES

FORMAT = 2  # increment it when `wheels_tree` or `prefix_build` makes something else
PYTHONS = ("3.10", "3.11", "3.12", "3.13")  # with ROS wheels on PyPI
PROGRAMS = ("python3", "colcon", "ros2")  # in bin, used by a verdict
NO_ROS = msg("there is no ROS {distro} at {path}")
INSTALL = msg("Install it, or unset GRADER_ROS to use PyPI's wheels.")
NO_WHEELS = msg("PyPI has no ROS wheels for {distro}")
OTHER_DISTRO = msg(
    "With Docker: make images DISTRO={distro}. Without: DISTRO=jazzy or DISTRO=kilted, or a machine that "
    "has ROS {distro} at /opt/ros/{distro}."
)
OTHER_PLATFORM = msg(
    "PyPI's ROS wheels are for Linux x86_64 and Python {versions}; this is {system} and Python "
    "{python}"
)
OTHER_PYTHON = msg("Run the grader with one of those Pythons, e.g. `make setup PYTHON=python3.12`.")
ONLY_DOCKER = msg("Use Docker: on this machine, ROS comes from an image.")
WITHOUT_DOCKER = say("Without Docker: SANDBOX=bubblewrap.")
NOT_WITHOUT = msg("Without Docker there is no ROS {distro} here.")
MAKING = msg("making the ROS {distro} prefix from PyPI's wheels (300 MB, once)")
MAKING_AGAIN = msg("{reason}\nmaking the prefix once more")
READY = msg("ROS {distro} is ready in {path}")


@dataclass(frozen=True)
class Ros:
    """A ROS installation: `path` on this machine, `interpreter` its Python."""

    distro: Distro
    kind: str  # wheels | system | image
    path: Path
    interpreter: Path
    versions: dict[str, str]

    @property
    def inside(self) -> str:
        """Its path in a sandbox."""
        return f"/opt/ros/{self.distro.name}"


class BrokenRosError(SurroundingsError):
    """A program of a ROS installation does not run."""


Prove = Callable[[Ros], None]
"""Starts the programs of a ROS installation; raises BrokenRosError if one does not run."""


def base_interpreter() -> Path:
    """Return the base Python of the current (virtual) environment."""
    version = f"{sys.version_info.major}.{sys.version_info.minor}"
    for name in (f"python{version}", "python3"):
        found = Path(sys.base_prefix) / "bin" / name
        if found.exists():
            return found.resolve()
    return Path(sys.executable).resolve()


def find_ros(distro: Distro, *, prove: Prove, notify: Notify = print) -> Ros:
    """Return the ROS installation for a distro; make and test the wheels prefix if necessary.

    $GRADER_ROS selects `wheels`, `system` (an existing /opt/ros/<distro>) or `auto` (the system's
    if it exists, else wheels). Raises SurroundingsError if neither is available.
    """
    choice = os.environ.get("GRADER_ROS", "auto")
    system = Path("/opt/ros") / distro.name
    is_wheels = (system / "wheels-prefix.json").is_file()
    is_system = (system / "setup.bash").is_file() and not is_wheels
    if choice == "system" or (choice == "auto" and is_system):
        if not is_system:
            raise SurroundingsError(
                Message(NO_ROS, {"distro": distro.name, "path": str(system)}),
                remedy=Message(INSTALL),
            )
        python = Path("/usr/bin/python3").resolve()
        return Ros(distro, "system", system, python, _system_versions(system))
    # a symlink belongs to the `account` sandbox, which removes it again
    if choice in ("auto", "wheels") and is_wheels and not system.is_symlink():
        return _wheels(distro, system, (system / "bin" / "python3").resolve())  # in an image
    return _wheels(distro, wheels_prefix(distro, prove=prove, notify=notify), base_interpreter())


def prefix_path(distro: Distro) -> Path:
    """Return the path of a distro's wheels prefix; its name has a hash of all its inputs."""
    python = ".".join(platform.python_version_tuple()[:2])
    if distro.lock is None:
        raise SurroundingsError(
            Message(NO_WHEELS, {"distro": distro.name}),
            remedy=Message(OTHER_DISTRO, {"distro": distro.name}),
        )
    if _other_machine() or python not in PYTHONS:
        raise SurroundingsError(
            Message(
                OTHER_PLATFORM,
                {
                    "versions": ", ".join(PYTHONS),
                    "system": f"{sys.platform} {platform.machine()}",
                    "python": python,
                },
            ),
            remedy=Message(ONLY_DOCKER if _other_machine() else OTHER_PYTHON),
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
    """Return the wheels prefix of a distro; make and test it if it is not in the cache.

    Raises BrokenRosError if a program does not run even after the prefix was made twice.
    """
    folder = prefix_path(distro)
    if folder.is_dir() and not is_complete(folder):
        discard(folder, unless=is_complete, notify=notify)
    if not folder.is_dir():
        notify(Message(MAKING, {"distro": distro.name}))
        make_once(folder, lambda staging: _make(distro, staging, prove, notify), notify=notify)
        notify(Message(READY, {"distro": distro.name, "path": str(folder)}))
    return folder


def instead_of_docker(distro: Distro) -> str:
    """Return what to do if there is no Docker: a sandbox without it, or a distro that has wheels."""
    if has_system_ros(distro):
        return WITHOUT_DOCKER
    try:
        prefix_path(distro)
    except SurroundingsError as error:
        return joined(Message(NOT_WITHOUT, {"distro": distro.name}), error.remedy)
    return WITHOUT_DOCKER


def has_system_ros(distro: Distro) -> bool:
    """Whether this machine has the distro at /opt/ros, and this user may read it."""
    return os.access(f"/opt/ros/{distro.name}/setup.bash", os.R_OK)


def _other_machine() -> bool:
    """Whether PyPI has no wheels for this kind of machine."""
    return platform.machine() != "x86_64" or sys.platform != "linux"


def is_in_cache(ros: Ros) -> bool:
    """Whether a ROS installation is in the grader's cache, so that it can be made again."""
    return ros.path.parent == _prefixes()


def _prefixes() -> Path:
    return cache_root() / "prefixes"


def is_complete(folder: Path, programs: Iterable[str] = PROGRAMS) -> bool:
    """Whether the programs exist (the Python that they link to may have been removed)."""
    return all(os.access(folder / "bin" / name, os.X_OK) for name in programs)


def _make(distro: Distro, staging: Path, prove: Prove, notify: Notify) -> None:
    try:
        _make_and_prove(distro, staging, prove, notify)
    except BrokenRosError as broken:
        notify(Message(MAKING_AGAIN, {"reason": broken.message}))
        for entry in staging.iterdir():
            if entry.is_dir() and not entry.is_symlink():
                shutil.rmtree(entry)
            else:
                entry.unlink()
        _make_and_prove(distro, staging, prove, notify)


def _make_and_prove(distro: Distro, staging: Path, prove: Prove, notify: Notify) -> None:
    interpreter = base_interpreter()
    make_prefix(distro, staging, interpreter, notify=notify)
    prove(_wheels(distro, staging, interpreter))


def _wheels(distro: Distro, path: Path, interpreter: Path) -> Ros:
    versions = json.loads((path / "wheels-prefix.json").read_text(encoding="utf-8"))
    return Ros(distro, "wheels", path, interpreter, versions)


def _system_versions(system: Path) -> dict[str, str]:
    versions = dict.fromkeys(VERSION_NAMES, "")
    manifest = system / "share" / "rclpy" / "package.xml"
    if manifest.is_file():
        match = re.search(
            r"<version>\s*([\d.]+)\s*</version>", manifest.read_text(encoding="utf-8")
        )
        versions["rclpy"] = match.group(1) if match else ""
    versions["rmw"] = "rmw_fastrtps_cpp"
    return versions
