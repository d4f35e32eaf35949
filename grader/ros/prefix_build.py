"""Makes the wheels prefix of a distro: pip installs the wheels, the rest makes a ROS prefix."""

from __future__ import annotations

import json
import os
import platform
import re
import shutil
import subprocess
import sys
from pathlib import Path

from grader.base.cache import Notify
from grader.base.errors import SurroundingsError
from grader.base.i18n.message import Message, msg
from grader.ros.distro import HERE, Distro
from grader.ros.scripts import HEADER, use_own_python

COMMAND = HERE / "ros2_command"  # our `ros2`, installed as COMMAND_MODULE
COMMAND_MODULE = "wheels_ros2"
VERSION_NAMES = ("rclpy", "rmw", "colcon", "setuptools", "python")
PROGRESS = msg("  {seen} of about {total} wheels")
UNPACKING = msg("  unpacking")
NO_VERSION = "(from versions: none)"  # pip's words if it reached no server
PIP_FAILED = msg("pip could not install the ROS {distro} wheels:\n{output}")
CHECK_NETWORK = msg(
    "Check the network (proxy: HTTPS_PROXY; certificate: PIP_CERT), then run the command again."
)


def make_prefix(distro: Distro, staging: Path, interpreter: Path, *, notify: Notify) -> None:
    """Make the wheels prefix of a distro in an empty folder, for this base interpreter.

    Raises SurroundingsError if pip cannot install the wheels.
    """
    python = f"{sys.version_info.major}.{sys.version_info.minor}"
    lock = distro.lock
    assert lock is not None
    install(distro.name, lock, staging, notify)
    site = staging / "lib" / f"python{python}" / "site-packages"
    if not (site / "rclpy").is_dir():
        raise SurroundingsError(f"pip did not install rclpy into {site}")
    for pth in site.glob("*.pth"):
        pth.unlink()  # they are not read on PYTHONPATH, but would be in a virtual environment
    _link_libraries(staging, site)
    use_own_python(staging / "bin", sys.executable)
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


def install(distro: str, lock: Path, staging: Path, notify: Notify) -> None:
    """Install the packages of a lock file into a prefix; raises SurroundingsError if pip fails."""
    total = len(re.findall(r"^[\w.-]+==", lock.read_text(encoding="utf-8"), re.MULTILINE))
    command = [sys.executable, "-I", "-m", "pip", "install", "--prefix", str(staging)]
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
        seen = 0
        for line in pip.stdout:
            tail = [*tail[-14:], line]
            if line.startswith("Collecting "):
                seen += 1
                if seen % 25 == 0:
                    notify(Message(PROGRESS, {"seen": seen, "total": total}))
            elif line.startswith("Installing collected"):
                notify(Message(UNPACKING))
    if pip.returncode:
        raise SurroundingsError(
            Message(PIP_FAILED, {"distro": distro, "output": _without_no_version(tail)}),
            remedy=Message(CHECK_NETWORK),
        )


def _without_no_version(output: list[str]) -> str:
    """Return pip's output; if it reached no server, without the lines that blame the package."""
    offline = any(NO_VERSION in line for line in output)
    kept = [line for line in output if not (offline and line.startswith("ERROR: "))]
    return "".join(kept if any(line.strip() for line in kept) else output).rstrip()


def _link(path: Path, target: str) -> None:
    path.unlink(missing_ok=True)
    path.symlink_to(target)


def _link_libraries(staging: Path, site: Path) -> None:
    """Link the wheels' bundled libraries into `lib`, so that one folder has all libraries."""
    for library in site.glob("ros_*.libs/*"):
        _link(staging / "lib" / library.name, os.path.relpath(library, staging / "lib"))


def _install_command(distro: Distro, site: Path, script: Path, interpreter: Path) -> None:
    target = site / COMMAND_MODULE
    shutil.copytree(COMMAND, target, ignore=shutil.ignore_patterns("__pycache__"))
    (target / "distro").write_text(distro.name, encoding="utf-8")
    compile_ = [str(interpreter), "-I", "-m", "compileall", "-q", str(target)]
    subprocess.run(compile_, check=False)  # only saves time; whether it runs is tested later
    # without `site`, whose folders (the base Python's) it does not need: 0.1 s
    header = HEADER.replace(b'/python3" ', b'/python3" -S ')
    script.write_bytes(
        header
        + f"from {COMMAND_MODULE}.cli import program\n\n".encode()
        + b'if __name__ == "__main__":\n    program()\n'
    )
    script.chmod(0o755)


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
