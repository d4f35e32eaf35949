"""The wheels prefix with which packages of interfaces are built, and which has turtlesim's.

It is the distro's wheels prefix (its files are hard links) with the packages of
`locks/<distro>-interfaces.txt`: ament_cmake, rosidl and CMake. turtlesim has no wheel: its
interfaces are built here, once, from the texts in `turtlesim/`. That needs a C++ compiler, so this
prefix is made when it is needed first, not with the other one. It also has turtlesim's programs.
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
from dataclasses import replace
from pathlib import Path

from grader.base.cache import Notify, discard, make_once
from grader.base.errors import SurroundingsError
from grader.base.i18n.message import Message, msg
from grader.ros.distro import HERE, Distro
from grader.ros.interface_package import BUILD, interface_package, texts_in
from grader.ros.prefix import PROGRAMS, Ros, is_complete, is_in_cache
from grader.ros.prefix_build import install
from grader.ros.scripts import use_own_python
from grader.ros.turtlesim_executables import install_programs, program_sources

FORMAT = 2  # increment it when this module makes something else
TEXTS = HERE / "turtlesim"
LINT = "ament_lint_auto"
SOURCES = ("interfaces.cmake.in", "interface_package.py", f"{LINT}.cmake")
MOST_OUTPUT = 2_000  # characters of the output of a failed build
PYTHON_INCLUDE = re.compile(r"/opt/python/[^/\";]+/include/python[\d.]+")
NUMPY_INCLUDE = re.compile(r"/opt/python/[^\";]*/numpy/_?core/include")
MAKING = msg("building turtlesim's interfaces for ROS {distro} (half a minute, once)")
READY = msg("turtlesim's interfaces are ready in {path}")
NO_COMPILER = msg("turtlesim's interfaces must be built once, but this machine has no {missing}")
INSTALL_COMPILER = msg(
    "Install a compiler: sudo apt-get install python3-dev g++ make. Lessons without turtlesim's "
    "interfaces need none."
)
NOT_BUILT = msg("turtlesim's interfaces could not be built:\n{output}")
REPORT = msg("Run the command again. If that does not help, report this error message.")
NOT_INSTALLED = msg("ROS {distro} at {path} has no package {package}")
INSTALL_PACKAGE = msg("Install it: sudo apt-get install ros-{distro}-{deb}")
OLD_IMAGE = msg("Make the images again: make images DISTRO={distro}")


def with_interfaces(ros: Ros, *, notify: Notify) -> Ros:
    """Return a ROS installation that has turtlesim's interfaces; make it if it is a wheels prefix.

    Raises SurroundingsError if the installation does not have them and cannot be changed, or if
    the compiler is missing.
    """
    package = ros.distro.turtlesim
    if (ros.path / "share" / package / "package.xml").is_file():
        return ros
    if not is_in_cache(ros):
        words = {"distro": ros.distro.name, "path": str(ros.path), "package": package}
        deb = {**words, "deb": package.replace("_", "-")}
        remedy = INSTALL_PACKAGE if ros.kind == "system" else OLD_IMAGE
        raise SurroundingsError(Message(NOT_INSTALLED, words), remedy=Message(remedy, deb))
    folder = interfaces_path(ros)
    if folder.is_dir() and not _is_complete(folder):
        discard(folder, unless=_is_complete, notify=notify)
    if not folder.is_dir():
        _require_compiler()
        notify(Message(MAKING, {"distro": ros.distro.name}))
        make_once(folder, lambda staging: make_interfaces(ros, staging, notify), notify=notify)
        notify(Message(READY, {"path": str(folder)}))
    return replace(ros, path=folder)


def interfaces_path(ros: Ros) -> Path:
    """Return the path of the prefix with interfaces that belongs to a wheels prefix."""
    key = hashlib.sha256(b"%d " % FORMAT + _lock(ros.distro).read_bytes())
    sources = [*(HERE / name for name in SOURCES), *sorted(TEXTS.rglob("*")), *program_sources()]
    for path in sources:
        if path.is_file():
            key.update(path.name.encode() + path.read_bytes())
    return ros.path.with_name(f"{ros.path.name}-interfaces-{key.hexdigest()[:16]}")


def make_interfaces(ros: Ros, staging: Path, notify: Notify) -> None:
    """Make the prefix in an empty folder beside the wheels prefix; raises SurroundingsError."""
    shutil.copytree(ros.path, staging, symlinks=True, copy_function=os.link, dirs_exist_ok=True)
    install(ros.distro.name, _lock(ros.distro), staging, notify)
    use_own_python(staging / "bin", sys.executable)
    _correct_paths(staging)
    lint = staging / "share" / LINT / "cmake"
    lint.mkdir(parents=True)
    shutil.copy(HERE / f"{LINT}.cmake", lint / f"{LINT}Config.cmake")
    package = ros.distro.turtlesim
    with tempfile.TemporaryDirectory(dir=staging.parent, prefix=".interfaces-") as folder:
        for path, text in interface_package(package, texts_in(TEXTS)).items():
            file = Path(folder, path)
            file.parent.mkdir(exist_ok=True)
            file.write_text(text, encoding="utf-8")
        _run(["bash", "-c", BUILD, "bash", str(staging), folder, str(staging)])
    install_programs(staging, ros.interpreter)
    parents = staging / "share" / "ament_index" / "resource_index" / "parent_prefix_path"
    (parents / package).write_text(ros.inside, encoding="utf-8")  # (the build wrote its own)
    code = f"import {package}.msg as m; m.Pose.__class__.__import_type_support__()"
    _run(["bash", "-c", '. "$0/setup.bash"; exec python3 -c "$1"', str(staging), code])


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


def _require_compiler() -> None:
    missing = missing_for_building()
    if missing:
        raise SurroundingsError(
            Message(NO_COMPILER, {"missing": ", ".join(missing)}),
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


def _run(command: list[str]) -> None:
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
        raise SurroundingsError(Message(NOT_BUILT, {"output": output}), remedy=Message(REPORT))
