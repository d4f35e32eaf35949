"""Wrong states of a student's workspace, written by hand, and what the guide must say of each.

Each starts from a right package in a workspace that was built before the entry point was added.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from tests.lab.workspaces import ENTRY, EXECUTABLE, MARKER, PACKAGE, SOLUTION, put

OWN = f"src/{PACKAGE}"
INNER = f"{OWN}/{PACKAGE}"
NODE = f"{INNER}/my_first_node.py"
SETUP = f"{OWN}/setup.py"
TARGET = "my_robot_controller.my_first_node:main"


@dataclass(frozen=True)
class Wrong:
    """A state: how it comes about, the step that is current, and texts that the guide must say.

    `never` are texts that would send the student wrong.
    """

    change: Callable[[Path], object]
    step: int
    says: tuple[str, ...]
    never: tuple[str, ...] = ()


def edit(workspace: Path, file: str, old: str, new: str) -> None:
    """Replace a text of a file; AssertionError if it is not there."""
    text = (workspace / file).read_text(encoding="utf-8")
    assert old in text, (file, old)
    (workspace / file).write_text(text.replace(old, new), encoding="utf-8")


def in_setup(old: str, new: str) -> Callable[[Path], object]:
    """Return an edit of setup.py."""
    return lambda workspace: edit(workspace, SETUP, old, new)


def in_node(old: str, new: str) -> Callable[[Path], object]:
    """Return an edit of the node's file."""
    return lambda workspace: edit(workspace, NODE, old, new)


def moved(*places: str) -> Callable[[Path], object]:
    """Return a move from place to place; `..` is the home folder."""

    def move(workspace: Path) -> None:
        for old, new in zip(places, places[1:]):
            target = workspace / new
            target.parent.mkdir(parents=True, exist_ok=True)
            (workspace / old).rename(target)

    return move


def renamed_everywhere(name: str) -> Callable[[Path], object]:
    """Return a change of the package's name in all of its files and folders."""

    def rename(workspace: Path) -> None:
        for file in ("package.xml", "setup.py", "setup.cfg"):
            edit(workspace, f"{OWN}/{file}", PACKAGE, name)
        (workspace / OWN / "resource" / PACKAGE).rename(workspace / OWN / "resource" / name)
        (workspace / INNER).rename(workspace / OWN / name)
        (workspace / OWN).rename(workspace / "src" / name)

    return rename


def misplaced_entry(workspace: Path) -> None:
    """Move the entry to a list of packages."""
    edit(workspace, SETUP, ENTRY, "")
    edit(workspace, SETUP, "zip_safe=True,", f"zip_safe=True,\n    tests_require=[{ENTRY}],")


def copied(workspace: Path) -> None:
    """Make a backup copy of the package in the same workspace."""
    shutil.copytree(workspace / OWN, workspace / f"{OWN}_old")


def cpp(workspace: Path) -> None:
    """Make it what `ros2 pkg create` makes without a build type."""
    (workspace / SETUP).unlink()
    put(workspace, f"{OWN}/CMakeLists.txt", "project(my_robot_controller)\n")


def built_in(folder: str) -> Callable[[Path], object]:
    """Return a build in a wrong folder, and none in the workspace."""

    def build(workspace: Path) -> None:
        shutil.rmtree(workspace / "install")
        for name in ("build", "install", "log"):
            (workspace / folder / name).mkdir()

    return build


def a_folder(workspace: Path) -> None:
    """Make a folder with the name of the node's file."""
    (workspace / NODE).unlink()
    (workspace / NODE).mkdir()


def built_before(target: str) -> Callable[[Path], object]:
    """Return a build with another target of the entry point."""

    def build(workspace: Path) -> None:
        put(workspace, EXECUTABLE, mode=0o755)
        text = f"[console_scripts]\ntest_node = {target}\n"
        put(workspace, f"build/{PACKAGE}/{PACKAGE}.egg-info/entry_points.txt", text)

    return build


def built_by_copy(workspace: Path) -> None:
    """Build without --symlink-install, then change the node."""
    put(workspace, EXECUTABLE, mode=0o755)
    site = f"install/{PACKAGE}/lib/python3.12/site-packages/{PACKAGE}/my_first_node.py"
    put(workspace, site, (workspace / NODE).read_text(encoding="utf-8"))
    edit(workspace, NODE, "Hello time", "Hello, time")


ADD = "Add this line"
CREATE = "ros2 pkg create"
TOUCH = "touch "

WRONG = {
    "a comma is missing in setup.py": Wrong(
        in_setup(ENTRY, f"{ENTRY[:-1]}\n            'other = {TARGET}',"),
        7,
        ("comma", "line 25"),
        (ADD,),
    ),
    "the executable is called testnode": Wrong(
        in_setup("'test_node =", "'testnode ="), 7, ("testnode", "test_node", "line 25"), (ADD,)
    ),
    "console_script": Wrong(
        in_setup("console_scripts", "console_script"), 7, ("console_script'", "line 24"), (ADD,)
    ),
    "gui_scripts": Wrong(in_setup("console_scripts", "gui_scripts"), 7, ("gui_scripts",), (ADD,)),
    "another module in the entry point": Wrong(
        in_setup(TARGET, "my_robot_controller.my_node:main"),
        7,
        ("my_node", "my_first_node"),
        (ADD,),
    ),
    "another function in the entry point": Wrong(
        in_setup(f"{TARGET}'", "my_robot_controller.my_first_node:mian'"), 7, ("mian",), (ADD,)
    ),
    "the entry stands in tests_require": Wrong(
        misplaced_entry,
        7,
        ("tests_require", "line 19"),
        (ADD,),
    ),
    "no entry yet": Wrong(in_setup(ENTRY, ""), 7, (ADD, ENTRY)),
    "Python cannot read setup.py": Wrong(
        in_setup("        ],\n    },", "        \n    },"), 7, ("cannot be read", "line 27"), (ADD,)
    ),
    "the node is in the outer folder": Wrong(
        moved(NODE, f"{OWN}/my_first_node.py"), 5, ("mv ", f"{OWN}/my_first_node.py"), (TOUCH,)
    ),
    "the node is in the test folder": Wrong(
        moved(NODE, f"{OWN}/test/my_first_node.py"), 5, ("mv ", "test/my_first_node.py"), (TOUCH,)
    ),
    "the node is in src": Wrong(
        moved(NODE, "src/my_first_node.py"), 5, ("mv ~/ros2_ws/src/my_first_node.py",), (TOUCH,)
    ),
    "the node is in the home folder": Wrong(
        moved(NODE, "../my_first_node.py"), 5, ("mv ~/my_first_node.py",), (TOUCH,)
    ),
    "my_frist_node.py": Wrong(
        moved(NODE, f"{INNER}/my_frist_node.py"), 5, ("mv ", "my_frist_node.py"), (TOUCH,)
    ),
    "my_first_node.py.txt": Wrong(
        moved(NODE, f"{NODE}.txt"), 5, ("mv ", "my_first_node.py.txt"), (TOUCH,)
    ),
    "MyFirstNode.py": Wrong(
        moved(NODE, f"{INNER}/MyFirstNode.py"), 5, ("mv ", "MyFirstNode.py"), (TOUCH,)
    ),
    "my-first-node.py": Wrong(
        moved(NODE, f"{INNER}/my-first-node.py"), 5, ("mv ", "my-first-node.py"), (TOUCH,)
    ),
    "a file without ending": Wrong(
        moved(NODE, f"{INNER}/my_first_node"), 5, ("mv ", f"{INNER}/my_first_node "), (TOUCH,)
    ),
    "a folder in place of the file": Wrong(a_folder, 5, ("is a folder", "rmdir ")),
    "the file is not executable": Wrong(
        lambda workspace: (workspace / NODE).chmod(0o644), 5, ("chmod +x",), (TOUCH,)
    ),
    "no __init__.py": Wrong(
        lambda workspace: (workspace / INNER / "__init__.py").unlink(), 5, ("__init__.py",)
    ),
    "the package is beside src": Wrong(
        moved(OWN, PACKAGE), 3, (f"mv ~/ros2_ws/{PACKAGE} ~/ros2_ws/{OWN}",), (CREATE,)
    ),
    "the package is in the home folder": Wrong(
        moved(OWN, f"../{PACKAGE}"), 3, (f"mv ~/{PACKAGE} ~/ros2_ws/{OWN}",), (CREATE,)
    ),
    "the package is in src/src": Wrong(
        moved(OWN, f"src/src/{PACKAGE}"), 3, (f"mv ~/ros2_ws/src/src/{PACKAGE}",), (CREATE,)
    ),
    "the package is in a folder of its own name": Wrong(
        moved(OWN, f"src/package/{PACKAGE}", f"{OWN}/{PACKAGE}"),
        3,
        (f"the package is in ~/ros2_ws/{OWN}/{PACKAGE};", "mv "),
        ("Delete", CREATE),
    ),
    "the package is misspelt": Wrong(
        renamed_everywhere("my_robot_conroller"), 3, ("my_robot_conroller", PACKAGE), ("cd ",)
    ),
    "the package's folder is misspelt": Wrong(
        moved(OWN, "src/my_robot_conroller"), 3, ("mv ~/ros2_ws/src/my_robot_conroller",), (CREATE,)
    ),
    "a C++ package": Wrong(cpp, 3, ("C++", "Delete", CREATE)),
    "setup.py was deleted": Wrong(
        lambda workspace: (workspace / SETUP).unlink(), 3, ("not complete",)
    ),
    "setup.cfg was deleted": Wrong(
        lambda workspace: (workspace / OWN / "setup.cfg").unlink(), 3, ("setup.cfg",), (CREATE,)
    ),
    "the marker was deleted": Wrong(
        lambda workspace: shutil.rmtree(workspace / OWN / "resource"), 3, ("resource/",), (CREATE,)
    ),
    "a tag of package.xml is not closed": Wrong(
        lambda workspace: edit(workspace, f"{OWN}/package.xml", "</license>", ""),
        3,
        ("<license> is not closed", "line 8"),
        (CREATE,),
    ),
    "a backup copy in the same workspace": Wrong(
        copied, 3, ("my_robot_controller_old", "COLCON_IGNORE"), (CREATE,)
    ),
    "built in src": Wrong(built_in("src"), 4, ("you built in ~/ros2_ws/src", "rm -r build")),
    "built in the package": Wrong(built_in(OWN), 4, (f"you built in ~/ros2_ws/{OWN}",)),
    "no shebang": Wrong(in_node("#!/usr/bin/env python3\n", ""), 6, ("first line",)),
    "typographic quotes": Wrong(
        in_node("'my_first_node'", "‘my_first_node’"), 6, ("this is not Python: ‘’", "line 12")
    ),
    "a line is indented too little": Wrong(
        in_node("        self.counter_ += 1", "      self.counter_ += 1"), 6, ("Indent", "line 19")
    ),
    "no timer": Wrong(
        in_node("self.create_timer(1.0, self.timer_callback)", "pass"), 6, ("no timer",)
    ),
    "nothing spins": Wrong(in_node("rclpy.spin(node)", "pass"), 6, ("does not spin",)),
    "the file is empty": Wrong(
        lambda workspace: (workspace / NODE).write_text(""), 6, ("Write the node",)
    ),
    "built before the entry was changed": Wrong(
        built_before("my_robot_controller.my_node:main"), 8, ("changed since", "colcon build")
    ),
    "built by copying, then changed": Wrong(built_by_copy, 8, ("older copy", "colcon build")),
    "not built since the entry was added": Wrong(lambda workspace: None, 8, ("colcon build",)),
}


def make(folder: Path, wrong: Wrong) -> Path:
    """Make the state's workspace in a home folder; return the workspace."""
    workspace = folder / "ros2_ws"
    (workspace / "src").mkdir(parents=True)
    shutil.copytree(SOLUTION, workspace / OWN)
    put(workspace, MARKER)
    wrong.change(workspace)
    return workspace
