"""The wheels prefix with which packages of interfaces are built, and which has turtlesim's.

It is the distro's wheels prefix (its files are hard links) with the packages of
`locks/<distro>-interfaces.txt`: ament_cmake, rosidl and CMake. turtlesim has no wheel: its
interfaces are built here, once, from the texts in `interface_texts/`. That needs a C++ compiler, so
this prefix is made when it is needed first, not with the other one. It also has turtlesim's programs.

Of the other packages in `interface_texts/`, each is built when an assignment names its types first:
then there is one more prefix, with hard links to the files of this one.
"""

from __future__ import annotations

import hashlib
import os
import shutil
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

from grader.base.cache import Notify, discard, make_once
from grader.base.errors import SurroundingsError
from grader.base.i18n.message import Message, msg
from grader.ros import wheels_tree
from grader.ros.distro import HERE, Distro
from grader.ros.interface_package import texts_in
from grader.ros.prefix import PROGRAMS, Ros, is_complete, is_in_cache
from grader.ros.prefix_build import install
from grader.ros.turtlesim_executables import install_programs, program_sources

FORMAT = 2  # increment it when this module makes something else
TEXTS = HERE / "interface_texts"
TURTLESIM = TEXTS / "turtlesim"
SOURCES = ("interfaces.cmake.in", "interface_package.py", f"{wheels_tree.LINT}.cmake")
MAKING = msg("building the interfaces of {package} for ROS {distro} (a minute or two, once)")
READY = msg("the interfaces of {package} are ready in {path}")
NO_COMPILER = msg("interfaces of {package} must be built once, but this machine has no {missing}")
INSTALL_COMPILER = msg(
    "Install a compiler: sudo apt-get install python3-dev g++ make. Lessons that use only ROS' own "
    "wheels need none."
)
NOT_BUILT = msg("the interfaces of {package} could not be built:\n{output}")
WITHOUT_TURTLESIM = msg("turtlesim is not in this lab: {problem}")
REPORT = msg("Run the command again. If that does not help, report this error message.")
NOT_INSTALLED = msg("ROS {distro} at {path} has no package {package}")
INSTALL_PACKAGE = msg("Install it: sudo apt-get install ros-{distro}-{deb}")
OLD_IMAGE = msg("Make the images again: make images DISTRO={distro}")


def with_interfaces(ros: Ros, packages: Sequence[str] = (), *, notify: Notify) -> Ros:
    """Return a ROS installation that has turtlesim's interfaces, and those of `packages`.

    They are built if it is a wheels prefix. Raises SurroundingsError if the installation does not
    have them and cannot be changed, or if the compiler is missing.
    """
    ros = _with_package(ros, ros.distro.turtlesim, interfaces_path(ros), make_interfaces, notify)
    for package in sorted({*packages} - {TURTLESIM.name}):
        key = hashlib.sha256(interfaces_path(ros).name.encode())
        for path, text in sorted(texts_in(TEXTS / package).items()):
            key.update(f"{path}\n{text}".encode())
        folder = ros.path.with_name(f"{ros.path.name}-{package}-{key.hexdigest()[:16]}")
        ros = _with_package(ros, package, folder, partial(_add_package, package), notify)
    return ros


def with_turtlesim(ros: Ros, *, notify: Notify) -> Ros:
    """Return a ROS installation with turtlesim if it has it or it can be built, else as it is.

    A failure is told with `notify`: nothing depends on turtlesim here.
    """
    if not is_in_cache(ros):
        return ros
    if not _is_complete(interfaces_path(ros)) and missing_for_building():
        return ros
    try:
        return with_interfaces(ros, notify=notify)
    except SurroundingsError as error:
        notify(Message(WITHOUT_TURTLESIM, {"problem": error.message}))
        return ros


def _with_package(
    ros: Ros, package: str, folder: Path, make: Callable[[Ros, Path, Notify], None], notify: Notify
) -> Ros:
    """Return an installation that has a package; `make` makes it in the cache's `folder`."""
    if (ros.path / "share" / package / "package.xml").is_file():
        return ros
    words = {"distro": ros.distro.name, "path": str(ros.path), "package": package}
    if not is_in_cache(ros):
        deb = {**words, "deb": package.replace("_", "-")}
        remedy = INSTALL_PACKAGE if ros.kind == "system" else OLD_IMAGE
        raise SurroundingsError(Message(NOT_INSTALLED, words), remedy=Message(remedy, deb))
    if folder.is_dir() and not _is_complete(folder):
        discard(folder, unless=_is_complete, notify=notify)
    if not folder.is_dir():
        _require_compiler(package)
        notify(Message(MAKING, words))
        make_once(folder, lambda staging: make(ros, staging, notify), notify=notify)
        notify(Message(READY, {**words, "path": str(folder)}))
    return replace(ros, path=folder)


def interfaces_path(ros: Ros) -> Path:
    """Return the path of the prefix with interfaces that belongs to a wheels prefix."""
    key = hashlib.sha256(b"%d " % FORMAT + _lock(ros.distro).read_bytes())
    sources = [*(HERE / name for name in SOURCES), *sorted(TURTLESIM.rglob("*"))]
    for path in [*sources, *program_sources()]:
        if path.is_file():
            key.update(path.name.encode() + path.read_bytes())
    return ros.path.with_name(f"{ros.path.name}-interfaces-{key.hexdigest()[:16]}")


def make_interfaces(ros: Ros, staging: Path, notify: Notify) -> None:
    """Make the prefix in an empty folder beside the wheels prefix; raises SurroundingsError."""
    _copy(ros, staging)
    install(ros.distro.name, _lock(ros.distro), staging, notify)
    wheels_tree.prepare_building(staging)
    _build(ros, staging, ros.distro.turtlesim, TURTLESIM)
    install_programs(staging, ros.interpreter)


def _add_package(package: str, ros: Ros, staging: Path, _notify: Notify) -> None:
    """Make a prefix with one package more; raises SurroundingsError."""
    _copy(ros, staging)
    _build(ros, staging, package, TEXTS / package)


def _copy(ros: Ros, staging: Path) -> None:
    shutil.copytree(ros.path, staging, symlinks=True, copy_function=os.link, dirs_exist_ok=True)


def _build(ros: Ros, prefix: Path, package: str, folder: Path) -> None:
    """Build and install a package of interfaces from its texts; raises SurroundingsError."""
    try:
        wheels_tree.build_interfaces(ros.inside, prefix, package, folder)
    except wheels_tree.InterfacesError as error:
        raise SurroundingsError(
            Message(NOT_BUILT, {"package": package, "output": str(error)}), remedy=Message(REPORT)
        ) from None


def _lock(distro: Distro) -> Path:
    assert distro.lock is not None
    return distro.lock.with_name(f"{distro.name}-interfaces.txt")


def _is_complete(folder: Path) -> bool:
    return is_complete(folder, (*PROGRAMS, "cmake"))


def missing_for_building() -> list[str]:
    """Return what this machine lacks for building interfaces; empty if it can."""
    missing = [name for name in ("g++", "make") if shutil.which(name) is None]
    if not Path(wheels_tree.python_include(), "Python.h").is_file():
        missing.append("Python.h")
    return missing


def _require_compiler(package: str) -> None:
    missing = missing_for_building()
    if missing:
        raise SurroundingsError(
            Message(NO_COMPILER, {"package": package, "missing": ", ".join(missing)}),
            remedy=Message(INSTALL_COMPILER),
        )
