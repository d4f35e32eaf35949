"""Makes the wheels prefix of a distro: pip installs the wheels, the rest makes a ROS prefix."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

from grader.base.cache import Notify
from grader.base.errors import SurroundingsError
from grader.base.i18n.message import Message, msg
from grader.ros import wheels_tree
from grader.ros.distro import HERE, Distro
from grader.ros.scripts import HEADER

COMMAND = HERE / "ros2_command"  # our `ros2`, installed as COMMAND_MODULE
COMMAND_MODULE = "wheels_ros2"
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
    lock = distro.lock
    assert lock is not None
    install(distro.name, lock, staging, notify)
    if not (wheels_tree.site_of(staging) / "rclpy").is_dir():
        raise SurroundingsError(f"pip did not install rclpy into {wheels_tree.site_of(staging)}")
    wheels_tree.arrange(distro.name, staging, interpreter)
    install_command(distro.name, staging, interpreter)


def install(distro: str, lock: Path, staging: Path, notify: Notify) -> None:
    """Install the packages of a lock file into a prefix; raises SurroundingsError if pip fails."""
    total = len(re.findall(r"^[\w.-]+==", lock.read_text(encoding="utf-8"), re.MULTILINE))
    seen = 0

    def heard(line: str) -> None:
        nonlocal seen
        if line.startswith("Collecting "):
            seen += 1
            if seen % 25 == 0:
                notify(Message(PROGRESS, {"seen": seen, "total": total}))
        elif line.startswith("Installing collected"):
            notify(Message(UNPACKING))

    try:
        wheels_tree.install(lock, staging, heard=heard)
    except wheels_tree.PipError as error:
        raise SurroundingsError(
            Message(PIP_FAILED, {"distro": distro, "output": _without_no_version(error.output)}),
            remedy=Message(CHECK_NETWORK),
        ) from None


def _without_no_version(output: list[str]) -> str:
    """Return pip's output; if it reached no server, without the lines that blame the package."""
    offline = any(NO_VERSION in line for line in output)
    kept = [line for line in output if not (offline and line.startswith("ERROR: "))]
    return "".join(kept if any(line.strip() for line in kept) else output).rstrip()


def install_command(distro: str, prefix: Path, interpreter: Path) -> None:
    """Install our `ros2` into a prefix."""
    target = wheels_tree.site_of(prefix) / COMMAND_MODULE
    script = prefix / "bin" / "ros2"
    shutil.copytree(COMMAND, target, ignore=shutil.ignore_patterns("__pycache__"))
    (target / "distro").write_text(distro, encoding="utf-8")
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
