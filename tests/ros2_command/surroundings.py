"""The surroundings of a `ros2` command in these tests: an ament workspace and a student's home."""

from __future__ import annotations

import os
import re
import shutil
import stat
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

from grader.sandbox.processes import stat_fields

PACKAGE = Path(__file__).parents[2] / "grader" / "ros" / "ros2_command"

# The executables that the recordings were made with; `hang` is line 11 of its module there
CODES = """\
import os
import signal
import sys

def three(): sys.exit(3)
def zero(): print(sys.argv[1:])
def term(): os.kill(os.getpid(), signal.SIGTERM)


def hang():
    import time; print("hanging",flush=True); time.sleep(60)


def wait():
    try:
        import time; print("waiting", flush=True); time.sleep(60)
    except KeyboardInterrupt:
        print("caught")
"""
SCRIPT = """\
#!{python}
import sys
sys.path.insert(0, {site!r})
from my_robot_controller import codes
sys.exit(codes.{function}())
"""


@dataclass(frozen=True)
class Finished:
    status: int
    stdout: str
    stderr: str


@dataclass(frozen=True)
class Surroundings:
    """A temporary folder `root` with a home, a prefix with the command, and a workspace."""

    root: Path
    distro: str = "jazzy"

    @property
    def prefix(self) -> Path:
        return self.root / "opt" / "ros"

    @property
    def overlay(self) -> Path:
        return self.root / "ws" / "install" / "my_robot_controller"

    @property
    def executables(self) -> Path:
        return self.overlay / "lib" / "my_robot_controller"

    @property
    def environment(self) -> dict[str, str]:
        return {
            "PATH": f"{self.prefix / 'bin'}:/usr/bin:/bin",
            "HOME": str(self.root / "home"),
            "LOGNAME": "student",
            "GIT_CONFIG_NOSYSTEM": "1",
            "GIT_CEILING_DIRECTORIES": str(self.root),
            "LC_ALL": "C.UTF-8",
            "COLUMNS": "80",
            "PYTHON_COLORS": "0",  # tracebacks on terminals are coloured since Python 3.13
            "ROS_DISTRO": self.distro,
            "AMENT_PREFIX_PATH": f"{self.overlay}:{self.prefix}",
        }

    def build(self) -> None:
        (self.root / "home").mkdir()
        site = self.prefix / "lib" / "site"
        # As in a real prefix: copied, under its own name
        shutil.copytree(PACKAGE, site / "wheels_ros2", ignore=shutil.ignore_patterns("__pycache__"))
        write_script(
            self.prefix / "bin" / "ros2",
            f"#!{sys.executable} -S\nimport sys\nsys.path.insert(0, {str(site)!r})\n"
            "from wheels_ros2.cli import main\nraise SystemExit(main())\n",
        )
        add_marker(self.prefix, "rclpy")
        add_marker(self.overlay, "my_robot_controller")
        modules = self.overlay / "lib" / "python3.12" / "site-packages"
        (modules / "my_robot_controller").mkdir(parents=True)
        (modules / "my_robot_controller" / "codes.py").write_text(CODES)
        for function in ("hang", "term", "three", "wait", "zero"):
            self.add_executable(
                function,
                SCRIPT.format(python=sys.executable, site=str(modules), function=function),
            )

    def add_executable(self, name: str, text: str) -> Path:
        return write_script(self.executables / name, text)

    def ros2(
        self, *arguments: str, cwd: Path | None = None, environment: Mapping[str, str] | None = None
    ) -> Finished:
        ros2 = str(self.prefix / "bin" / "ros2")
        return self.command(ros2, *arguments, cwd=cwd, environment=environment)

    def command(
        self, *command: str, cwd: Path | None = None, environment: Mapping[str, str] | None = None
    ) -> Finished:
        done = subprocess.run(
            command,
            cwd=cwd or self.root,
            env={**self.environment, **(environment or {})},
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )
        return Finished(done.returncode, done.stdout, done.stderr)

    def normalised(self, text: str) -> str:
        return text.replace(str(self.prefix), "<PREFIX>").replace(str(self.root), "<ROOT>")


def write_script(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    path.chmod(0o755)
    return path


def add_marker(prefix: Path, package: str) -> Path:
    marker = prefix / "share" / "ament_index" / "resource_index" / "packages" / package
    marker.parent.mkdir(parents=True, exist_ok=True)
    marker.write_text("")
    share = prefix / "share" / package
    share.mkdir(parents=True, exist_ok=True)
    (share / "package.xml").write_text(
        f'<package format="3"><name>{package}</name><depend>rclpy</depend>'
        "<depend>std_msgs</depend></package>\n"
    )
    return marker


def files(folder: Path) -> dict[str, dict[str, object]]:
    """Describe the content of a folder in the format of the recordings."""
    return {_name(path, folder): _describe(path) for path in sorted(folder.rglob("*"))}


def _name(path: Path, folder: Path) -> str:
    return str(path.relative_to(folder)) + ("/" if path.is_dir() else "")


def _describe(path: Path) -> dict[str, object]:
    found: dict[str, object] = {"mode": oct(stat.S_IMODE(path.stat().st_mode))}
    if path.is_dir():
        return found
    found["bytes"] = path.stat().st_size
    if path.name == "package.xml":
        found["elements"] = [
            [element.tag, dict(element.attrib), (element.text or "").strip()]
            for element in ElementTree.parse(path).getroot().iter()
        ][1:]
    if path.name == "setup.cfg":
        found["text"] = path.read_text()
    if path.name == "setup.py":
        found["setup_arguments"] = _setup_arguments(path.read_text())
    return found


def _setup_arguments(text: str) -> dict[str, str]:
    import ast

    call = next(
        node
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.Call) and ast.unparse(node.func) == "setup"
    )
    return {str(word.arg): ast.unparse(word.value) for word in call.keywords}


def without_places(traceback: str) -> str:
    """Remove what differs between Pythons and folders: ^^^^ marks, file names, line numbers."""
    text = re.sub(r'File "[^"]*", line \d+', 'File "…"', traceback)
    return re.sub(r"^ *[\^~]+\r?\n", "", text, flags=re.MULTILINE)


def running(process: int) -> bool:
    """Return whether a process is running; a zombie is not."""
    try:
        return stat_fields(process)[0] != "Z"
    except FileNotFoundError:
        return False


def umask_of_a_student() -> int:
    """Set the umask of the recordings and return the former one."""
    return os.umask(0o022)
