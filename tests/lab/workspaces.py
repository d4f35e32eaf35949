"""Folders for workspaces, and workspaces in the states of the exercise."""

from __future__ import annotations

import contextlib
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path

from tests import processes


@contextlib.contextmanager
def open_to_all() -> Iterator[Path]:
    """Yield a folder that any user of this machine may write to (pytest's are private)."""
    folder = Path(tempfile.mkdtemp(prefix="lab-test-"))
    try:
        folder.chmod(0o777)
        yield folder
    finally:
        shutil.rmtree(folder)


PACKAGE = "my_robot_controller"
SOLUTION = processes.ROOT / "grader/keys/hello_time/solution" / PACKAGE
MARKER = f"install/{PACKAGE}/share/ament_index/resource_index/packages/{PACKAGE}"
EXECUTABLE = f"install/{PACKAGE}/lib/{PACKAGE}/test_node"
ENTRY = "'test_node = my_robot_controller.my_first_node:main',"
SETUP = (SOLUTION / "setup.py").read_text(encoding="utf-8").replace(ENTRY, "ENTRY")


def put(workspace: Path, file: str, text: str = "", *, mode: int = 0o644) -> Path:
    """Write a file of a workspace and make its parent folders."""
    path = workspace / file
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    path.chmod(mode)
    return path


def after_step(workspace: Path, step: int, node: str) -> dict[str, str]:
    """Bring a workspace to the state after a step; return the terminal's variables."""
    inner = f"src/{PACKAGE}/{PACKAGE}"
    (workspace / "src").mkdir(parents=True)
    if step >= 3:
        for file in ("package.xml", "setup.cfg", f"resource/{PACKAGE}"):
            put(workspace, f"src/{PACKAGE}/{file}", (SOLUTION / file).read_text(encoding="utf-8"))
        put(workspace, f"src/{PACKAGE}/setup.py", SETUP.replace("ENTRY", ""))
        put(workspace, f"{inner}/__init__.py")
    if step >= 4:
        put(workspace, MARKER)
    if step >= 5:
        put(workspace, f"{inner}/my_first_node.py", mode=0o755)
    if step >= 6:
        put(workspace, f"{inner}/my_first_node.py", node, mode=0o755)
    if step >= 7:
        put(workspace, f"src/{PACKAGE}/setup.py", SETUP.replace("ENTRY", ENTRY))
    if step >= 8:
        put(workspace, EXECUTABLE, mode=0o755)
    prefixes = ["/opt/ros/jazzy"]
    if step >= 9:
        prefixes.insert(0, str(workspace / "install" / PACKAGE))
    return {"ROS_DISTRO": "jazzy", "AMENT_PREFIX_PATH": ":".join(prefixes)}
