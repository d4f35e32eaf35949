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
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

from grader.base.cache import Notify, discard, make_once
from grader.base.errors import SurroundingsError
from grader.base.i18n.message import Message, msg
from grader.ros.distro import HERE, Distro
from grader.ros.interface_package import BUILD, USED, interface_package, texts_in
from grader.ros.prefix import PROGRAMS, Ros, is_complete, is_in_cache
from grader.ros.prefix_build import install
from grader.ros.scripts import use_own_python
from grader.ros.turtlesim_executables import install_programs, program_sources

FORMAT = 2  # increment it when this module makes something else
TEXTS = HERE / "interface_texts"
TURTLESIM = TEXTS / "turtlesim"
LINT = "ament_lint_auto"
SOURCES = ("interfaces.cmake.in", "interface_package.py", f"{LINT}.cmake")
MOST_OUTPUT = 2_000  # characters of the output of a failed build
PYTHON_INCLUDE = re.compile(r"/opt/python/[^/\";]+/include/python[\d.]+")
NUMPY_INCLUDE = re.compile(r"/opt/python/[^\";]*/numpy/_?core/include")
MAKING = msg("building the interfaces of {package} for ROS {distro} (a minute or two, once)")
READY = msg("the interfaces of {package} are ready in {path}")
NO_COMPILER = msg("interfaces of {package} must be built once, but this machine has no {missing}")
INSTALL_COMPILER = msg(
    "Install a compiler: sudo apt-get install python3-dev g++ make. Lessons that use only ROS' own "
    "wheels need none."
)
NOT_BUILT = msg("the interfaces of {package} could not be built:\n{output}")
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
    use_own_python(staging / "bin", sys.executable)
    _correct_paths(staging)
    lint = staging / "share" / LINT / "cmake"
    lint.mkdir(parents=True)
    shutil.copy(HERE / f"{LINT}.cmake", lint / f"{LINT}Config.cmake")
    _build(ros, staging, ros.distro.turtlesim, TURTLESIM)
    install_programs(staging, ros.interpreter)


def _add_package(package: str, ros: Ros, staging: Path, _notify: Notify) -> None:
    """Make a prefix with one package more; raises SurroundingsError."""
    _copy(ros, staging)
    _build(ros, staging, package, TEXTS / package)


def _copy(ros: Ros, staging: Path) -> None:
    shutil.copytree(ros.path, staging, symlinks=True, copy_function=os.link, dirs_exist_ok=True)


def _build(ros: Ros, prefix: Path, package: str, folder: Path) -> None:
    """Build and install a package of interfaces from its texts, and load one of its messages."""
    texts = texts_in(folder)
    used = {name for text in texts.values() for name in USED.findall(text)} - {package}
    with tempfile.TemporaryDirectory(dir=prefix.parent, prefix=".interfaces-") as made:
        for path, text in interface_package(package, texts, used).items():
            file = Path(made, path)
            file.parent.mkdir(exist_ok=True)
            file.write_text(text, encoding="utf-8")
        _run(package, ["bash", "-c", BUILD, "bash", str(prefix), made, str(prefix)])
    parents = prefix / "share" / "ament_index" / "resource_index" / "parent_prefix_path"
    (parents / package).write_text(ros.inside, encoding="utf-8")  # (the build wrote its own)
    message = next(Path(path).stem for path in sorted(texts) if path.startswith("msg/"))
    code = f"import {package}.msg as m; m.{message}.__class__.__import_type_support__()"
    _run(package, ["bash", "-c", '. "$0/setup.bash"; exec python3 -c "$1"', str(prefix), code])


def _lock(distro: Distro) -> Path:
    assert distro.lock is not None
    return distro.lock.with_name(f"{distro.name}-interfaces.txt")


def _is_complete(folder: Path) -> bool:
    return is_complete(folder, (*PROGRAMS, "cmake"))


def missing_for_building() -> list[str]:
    """Return what this machine lacks for building interfaces; empty if it can."""
    missing = [name for name in ("g++", "make") if shutil.which(name) is None]
    if not Path(_python_include(), "Python.h").is_file():
        missing.append("Python.h")
    return missing


def _require_compiler(package: str) -> None:
    missing = missing_for_building()
    if missing:
        raise SurroundingsError(
            Message(NO_COMPILER, {"package": package, "missing": ", ".join(missing)}),
            remedy=Message(INSTALL_COMPILER),
        )


def _python_include() -> str:
    return sysconfig.get_path("include")


def _correct_paths(staging: Path) -> None:
    """Replace the paths of the machine that built the wheels, in their CMake files."""
    site = next((staging / "lib").glob("python3*/site-packages"))
    core = next(name for name in ("_core", "core") if (site / "numpy" / name / "include").is_dir())
    numpy = f"${{CMAKE_CURRENT_LIST_DIR}}/../../../lib/{site.parent.name}/site-packages/numpy"
    for file in (staging / "share").rglob("*.cmake"):
        text = file.read_text(encoding="utf-8")
        new = NUMPY_INCLUDE.sub(lambda _: f"{numpy}/{core}/include", text)
        new = PYTHON_INCLUDE.sub(lambda _: _python_include(), new)
        if new != text:
            file.unlink()  # a hard link: the file of the other prefix stays as it is
            file.write_text(new, encoding="utf-8")


def _run(package: str, command: list[str]) -> None:
    done = subprocess.run(
        command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        env={"PATH": "/usr/local/bin:/usr/bin:/bin", "LANG": "C.UTF-8"},
        check=False,
    )
    if done.returncode:
        output = done.stdout.decode(errors="replace")[-MOST_OUTPUT:]
        raise SurroundingsError(
            Message(NOT_BUILT, {"package": package, "output": output}), remedy=Message(REPORT)
        )
