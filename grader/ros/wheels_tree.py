"""What takes minutes of a wheels prefix: the packages of pip, and the interfaces that are compiled.

It depends on the lock files and on the interface texts only, so that an image keeps it when other code
changes: it imports nothing of the grader but its two neighbours. `prefix_build` adds our own programs.
"""

from __future__ import annotations

import hashlib
import json
import os
import platform
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from collections.abc import Callable
from pathlib import Path

from grader.ros.interface_package import BUILD, USED, interface_package, texts_in
from grader.ros.scripts import use_own_python

HERE = Path(__file__).resolve().parent
VERSION_NAMES = ("rclpy", "rmw", "colcon", "setuptools", "python")
LINT = "ament_lint_auto"
MOST_OUTPUT = 2_000  # characters of the output of a failed build
SHARED = 100_000  # bytes of a library from which a copy of it is replaced by a link
TAIL = 15  # lines of pip's output
PYTHON_INCLUDE = re.compile(r"/opt/python/[^/\";]+/include/python[\d.]+")
NUMPY_INCLUDE = re.compile(r"/opt/python/[^\";]*/numpy/_?core/include")


class PipError(Exception):
    """pip could not install the packages; `output` has its last lines."""

    def __init__(self, output: list[str]) -> None:
        super().__init__("".join(output))
        self.output = output


class InterfacesError(Exception):
    """A package of interfaces could not be built; the text is the end of the output."""

    def __init__(self, package: str, output: str) -> None:
        super().__init__(output)
        self.package = package


def install(lock: Path, prefix: Path, *, heard: Callable[[str], None]) -> None:
    """Install the packages of a lock file into a prefix; `heard` gets each line of pip's output."""
    command = [sys.executable, "-I", "-m", "pip", "install", "--prefix", str(prefix)]
    command += ["--ignore-installed", "--no-deps", "--require-hashes", "-r", str(lock)]
    # empy 3.3.4 has no wheel: it is built with this environment's pinned setuptools
    command += ["--only-binary", ":all:", "--no-binary", "empy", "--no-build-isolation"]
    command += ["--no-warn-script-location", "--disable-pip-version-check", "--no-input"]
    environment = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "PYTHONHOME")}
    with subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        errors="replace",
        env=environment,
    ) as pip:
        assert pip.stdout is not None
        tail: list[str] = []
        for line in pip.stdout:
            tail = [*tail[1 - TAIL :], line]
            heard(line)
    if pip.returncode:
        raise PipError(tail)


def site_of(prefix: Path) -> Path:
    """Return the folder of this Python's packages in a prefix."""
    return prefix / "lib" / f"python{_version()}" / "site-packages"


def arrange(distro: str, prefix: Path, interpreter: Path) -> None:
    """Make a ROS prefix of what pip has installed: libraries, programs, setup files, versions."""
    site = site_of(prefix)
    for pth in site.glob("*.pth"):
        pth.unlink()  # they are not read on PYTHONPATH, but would be in a virtual environment
    for library in site.glob("ros_*.libs/*"):  # so that one folder has all libraries
        _link(prefix / "lib" / library.name, os.path.relpath(library, prefix / "lib"))
    use_own_python(prefix / "bin", sys.executable)
    _link(prefix / "bin" / "python3", str(interpreter))
    text = (HERE / "setup.bash.in").read_text(encoding="utf-8")
    fill = {"@DISTRO@": distro, "@PYTHON@": _version(), "@PREFIX@": f"/opt/ros/{distro}"}
    for mark, value in fill.items():
        text = text.replace(mark, value)
    for name in ("setup", "local_setup"):
        for shell in ("bash", "sh", "zsh"):
            (prefix / f"{name}.{shell}").write_text(text, encoding="utf-8")
    versions = json.dumps(_versions(site), indent=1)
    (prefix / "wheels-prefix.json").write_text(versions, encoding="utf-8")


def prepare_building(prefix: Path) -> None:
    """Make a prefix with the packages of an `-interfaces` lock one that builds interfaces."""
    use_own_python(prefix / "bin", sys.executable)
    _correct_paths(prefix)
    lint = prefix / "share" / LINT / "cmake"
    lint.mkdir(parents=True)
    shutil.copy(HERE / f"{LINT}.cmake", lint / f"{LINT}Config.cmake")


def build_interfaces(inside: str, prefix: Path, package: str, folder: Path) -> None:
    """Build and install a package of interfaces from its texts, and load one of its messages.

    `inside` is the prefix' path for students. Raises InterfacesError.
    """
    texts = texts_in(folder)
    used = {name for text in texts.values() for name in USED.findall(text)} - {package}
    with tempfile.TemporaryDirectory(dir=prefix.parent, prefix=".interfaces-") as made:
        for path, text in interface_package(package, texts, used).items():
            file = Path(made, path)
            file.parent.mkdir(exist_ok=True)
            file.write_text(text, encoding="utf-8")
        _run(package, ["bash", "-c", BUILD, "bash", str(prefix), made, str(prefix)])
    parents = prefix / "share" / "ament_index" / "resource_index" / "parent_prefix_path"
    (parents / package).write_text(inside, encoding="utf-8")  # (the build wrote its own)
    message = next(Path(path).stem for path in sorted(texts) if path.startswith("msg/"))
    code = f"import {package}.msg as m; m.{message}.__class__.__import_type_support__()"
    _run(package, ["bash", "-c", '. "$0/setup.bash"; exec python3 -c "$1"', str(prefix), code])


def share_equal_libraries(prefix: Path) -> None:
    """Replace copies of the same library in a prefix by links: half of the wheels' bundle OpenSSL.

    The loader finds a library by its name in the folder of the one that needs it; a link is as good.
    """
    first: dict[tuple[int, str], Path] = {}
    places = [*site_of(prefix).glob("*.libs/*"), *sorted((prefix / "lib").glob("*.so*"))]
    for path in places:
        if path.is_symlink() or not path.is_file() or path.stat().st_size < SHARED:
            continue
        key = (path.stat().st_size, hashlib.sha256(path.read_bytes()).hexdigest())
        kept = first.setdefault(key, path)
        if kept != path:
            _link(path, os.path.relpath(kept, path.parent))


def python_include() -> str:
    """Return the folder of this Python's headers."""
    return sysconfig.get_path("include")


def _version() -> str:
    return f"{sys.version_info.major}.{sys.version_info.minor}"


def _link(path: Path, target: str) -> None:
    path.unlink(missing_ok=True)
    path.symlink_to(target)


def _versions(site: Path) -> dict[str, str]:
    from importlib.metadata import distributions  # noqa: PLC0415 - slow, and rarely needed

    found = {d.metadata["Name"]: d.version for d in distributions(path=[str(site)])}
    wanted = {
        "rclpy": found.get("ros-rclpy", ""),
        "rmw": f"rmw_fastrtps_cpp {found.get('ros-rmw-fastrtps-cpp', '')}",
        "colcon": found.get("colcon-core", ""),
        "setuptools": found.get("setuptools", ""),
        "python": platform.python_version(),
    }
    return {name: wanted[name] for name in VERSION_NAMES}


def _correct_paths(prefix: Path) -> None:
    """Replace the paths of the machine that built the wheels, in their CMake files."""
    site = next((prefix / "lib").glob("python3*/site-packages"))
    core = next(name for name in ("_core", "core") if (site / "numpy" / name / "include").is_dir())
    numpy = f"${{CMAKE_CURRENT_LIST_DIR}}/../../../lib/{site.parent.name}/site-packages/numpy"
    for file in (prefix / "share").rglob("*.cmake"):
        text = file.read_text(encoding="utf-8")
        new = NUMPY_INCLUDE.sub(lambda _: f"{numpy}/{core}/include", text)
        new = PYTHON_INCLUDE.sub(lambda _: python_include(), new)
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
        raise InterfacesError(package, done.stdout.decode(errors="replace")[-MOST_OUTPUT:])


def main(distro: str, interpreter: str, turtlesim: str) -> None:
    """Make a distro's prefix at /opt/ros, with turtlesim's interfaces (a package of that name).

    For the image's build.
    """
    prefix = Path("/opt/ros") / distro
    locks = [HERE / "locks" / f"{distro}{kind}.txt" for kind in ("", "-interfaces")]
    install(locks[0], prefix, heard=print)
    arrange(distro, prefix, Path(interpreter))
    install(locks[1], prefix, heard=print)
    prepare_building(prefix)
    build_interfaces(str(prefix), prefix, turtlesim, HERE / "interface_texts" / "turtlesim")
    share_equal_libraries(prefix)


if __name__ == "__main__":
    main(*sys.argv[1:])
