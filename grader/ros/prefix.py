"""A ROS prefix made of PyPI's wheels: no root, no Docker, one folder in the cache.

It is laid out like `/opt/ros/<distro>` of the Debian packages (`lib/pythonX.Y/site-packages` found
by PYTHONPATH, shared libraries in `lib`), not as a virtual environment: so colcon and setup.py
behave as under ROS's own, and no Python is started twice by the wheels' `.pth` file.
"""

from __future__ import annotations

import hashlib
import importlib.metadata
import json
import os
import platform
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from grader.errors import SurroundingsError
from grader.locale.message import Message
from grader.ros import prefix_texts as texts
from grader.ros.cache import Say
from grader.ros.cache import cache_root
from grader.ros.cache import make_once
from grader.ros.distro import HERE
from grader.ros.distro import Distro

FORMAT = 1  # raise it when the making below changes
PYTHONS = ("3.10", "3.11", "3.12", "3.13")  # those that PyPI has ROS wheels for
COMMAND = HERE / "ros2_command"  # our `ros2`, installed as the module below
COMMAND_MODULE = "wheels_ros2"
SUPPLY = ("rclpy", "rmw", "colcon", "setuptools", "python")


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


def base_interpreter() -> Path:
    """Return the Python behind the running (virtual) environment."""
    version = f"{sys.version_info.major}.{sys.version_info.minor}"
    for name in (f"python{version}", "python3"):
        found = Path(sys.base_prefix) / "bin" / name
        if found.exists():
            return found.resolve()
    return Path(sys.executable).resolve()


def find_ros(distro: Distro, *, say: Say = print) -> Ros:
    """Return the ROS installation for a distro, making the wheels prefix if need be.

    $GRADER_ROS chooses: `wheels`, `system` (an existing /opt/ros/<distro>) or `auto` (the system's
    where it is there). Raises SurroundingsError where neither is to be had.
    """
    choice = os.environ.get("GRADER_ROS", "auto")
    system = Path("/opt/ros") / distro.name
    is_system = (system / "setup.bash").is_file() and not (system / "wheels-prefix.json").is_file()
    if choice == "system" or (choice == "auto" and is_system):
        if not is_system:
            raise SurroundingsError(
                Message(texts.NO_ROS, {"distro": distro.name, "path": str(system)}),
                remedy=Message(texts.INSTALL),
            )
        python = Path("/usr/bin/python3").resolve()
        return Ros(distro, "system", system, python, _system_versions(system))
    if choice in ("auto", "wheels") and (system / "wheels-prefix.json").is_file():
        path, interpreter = system, (system / "bin" / "python3").resolve()  # in an image of ours
    else:
        path, interpreter = wheels_prefix(distro, say=say), base_interpreter()
    versions = json.loads((path / "wheels-prefix.json").read_text(encoding="utf-8"))
    return Ros(distro, "wheels", path, interpreter, versions)


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
    key = hashlib.sha256(f"{FORMAT} {base_interpreter()}".encode())
    key.update(distro.lock.read_bytes())
    key.update((HERE / "setup.bash.in").read_bytes())
    for source in sorted(COMMAND.rglob("*")):
        if source.is_file() and source.suffix != ".pyc":
            key.update(str(source.relative_to(COMMAND)).encode() + source.read_bytes())
    tag = f"cp{python.replace('.', '')}-{platform.machine()}"
    return cache_root() / "prefixes" / f"{distro.name}-{tag}-{key.hexdigest()[:16]}"


def wheels_prefix(distro: Distro, *, say: Say = print) -> Path:
    """Return the wheels prefix of a distro, made now if it is not in the cache."""
    folder = prefix_path(distro)
    if not folder.is_dir():
        say(Message(texts.MAKING, {"distro": distro.name}))
        make_once(folder, lambda staging: _make(distro, staging, say), say=say)
        say(Message(texts.READY, {"distro": distro.name, "path": str(folder)}))
    return folder


def _make(distro: Distro, staging: Path, say: Say) -> None:
    python = f"{sys.version_info.major}.{sys.version_info.minor}"
    _install(distro, staging, say)
    site = staging / "lib" / f"python{python}" / "site-packages"
    if not (site / "rclpy").is_dir():
        raise SurroundingsError(f"pip did not install rclpy into {site}")
    interpreter = base_interpreter()
    for start_up in site.glob("*.pth"):
        start_up.unlink()  # PYTHONPATH would not read them; a virtual environment would
    _link_libraries(staging, site)
    _mend_scripts(staging / "bin", interpreter)
    _link(staging / "bin" / "python3", str(interpreter))
    _install_command(distro, site, staging / "bin" / "ros2", interpreter)
    text = (HERE / "setup.bash.in").read_text(encoding="utf-8")
    fill = {"@DISTRO@": distro.name, "@PYTHON@": python, "@PREFIX@": f"/opt/ros/{distro.name}"}
    for mark, value in fill.items():
        text = text.replace(mark, value)
    for name in ("setup", "local_setup"):
        for shell in ("bash", "sh", "zsh"):
            (staging / f"{name}.{shell}").write_text(text, encoding="utf-8")
    versions = _versions(site)
    (staging / "wheels-prefix.json").write_text(json.dumps(versions, indent=1), encoding="utf-8")


def _install(distro: Distro, staging: Path, say: Say) -> None:
    lock = distro.lock
    assert lock is not None
    total = len(re.findall(r"^[\w.-]+==", lock.read_text(encoding="utf-8"), re.MULTILINE))
    command = [sys.executable, "-m", "pip", "install", "--prefix", str(staging)]
    command += ["--ignore-installed", "--no-deps", "--require-hashes", "-r", str(lock)]
    # empy 3.3.4 has no wheel: it is built with the pinned setuptools of this environment
    command += ["--only-binary", ":all:", "--no-binary", "empy", "--no-build-isolation"]
    command += ["--no-warn-script-location", "--disable-pip-version-check", "--no-input"]
    environment = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "PYTHONHOME")}
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment
    ) as pip:
        assert pip.stdout is not None
        tail: list[str] = []
        seen = 0
        for line in pip.stdout:
            tail = [*tail[-14:], line]
            if line.startswith("Collecting "):
                seen += 1
                if seen % 25 == 0:
                    say(Message(texts.PROGRESS, {"seen": seen, "total": total}))
            elif line.startswith("Installing collected"):
                say(Message(texts.UNPACKING))
    if pip.returncode:
        raise SurroundingsError(
            Message(texts.PIP_FAILED, {"distro": distro.name, "output": "".join(tail).rstrip()}),
            remedy=Message(texts.CHECK_NETWORK),
        )


def _link(path: Path, target: str) -> None:
    path.unlink(missing_ok=True)
    path.symlink_to(target)


def _link_libraries(staging: Path, site: Path) -> None:
    """Bring the wheels' bundled libraries into `lib`, so that one folder has them all."""
    for library in site.glob("ros_*.libs/*"):
        _link(staging / "lib" / library.name, os.path.relpath(library, staging / "lib"))


def _mend_scripts(folder: Path, interpreter: Path) -> None:
    """Point the scripts at the base interpreter: the environment that ran pip may go away."""
    for script in folder.iterdir():
        data = script.read_bytes() if script.is_file() else b""
        first, _, rest = data.partition(b"\n")
        if first.startswith(b"#!") and b"python" in first:
            script.write_bytes(b"#!" + os.fsencode(interpreter) + b"\n" + rest)


def _install_command(distro: Distro, site: Path, script: Path, interpreter: Path) -> None:
    target = site / COMMAND_MODULE
    shutil.copytree(COMMAND, target, ignore=shutil.ignore_patterns("__pycache__"))
    (target / "distro").write_text(distro.name, encoding="utf-8")
    compile_ = [str(interpreter), "-m", "compileall", "-q", str(target)]
    subprocess.run(compile_, check=True)
    script.write_text(
        f"#!{interpreter}\n"
        f"from {COMMAND_MODULE}.cli import main\n\n"
        'if __name__ == "__main__":\n    raise SystemExit(main())\n',
        encoding="utf-8",
    )
    script.chmod(0o755)


def _versions(site: Path) -> dict[str, str]:
    found = {
        d.metadata["Name"]: d.version for d in importlib.metadata.distributions(path=[str(site)])
    }
    wanted = {
        "rclpy": found.get("ros-rclpy", ""),
        "rmw": f"rmw_fastrtps_cpp {found.get('ros-rmw-fastrtps-cpp', '')}",
        "colcon": found.get("colcon-core", ""),
        "setuptools": found.get("setuptools", ""),
        "python": platform.python_version(),
    }
    return {name: wanted[name] for name in SUPPLY}


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
