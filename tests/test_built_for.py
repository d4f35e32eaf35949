"""A workspace that was built for another ROS is recognised by what its build has written."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from grader.ros import built_for
from grader.ros.built_for import Built, change
from tests import processes

PACKAGE = "my_package"


def build(workspace: Path, root: str = "/opt/ros/jazzy", python: str = "3.12") -> Path:
    """Write what colcon writes into install: see `install/setup.sh` of a real build."""
    wheels = python == "3.13"
    own = f"{root}/bin/python3" if wheels else "/usr/bin/python3"
    install = workspace / "install"
    (install / PACKAGE / "lib" / f"python{python}" / "site-packages").mkdir(parents=True)
    (install / "setup.sh").write_text(f'COLCON_CURRENT_PREFIX="{root}"\n')
    (install / "local_setup.sh").write_text(f'  _colcon_python_executable="{own}"\n')
    return install


def ros(root: Path, distro: str = "jazzy", python: str = "3.12") -> Path:
    """Make what tells which ROS is here."""
    (root / distro / "lib" / f"python{python}" / "site-packages").mkdir(parents=True)
    if python == "3.13":
        (root / distro / "bin").mkdir()
        (root / distro / "bin" / "python3").symlink_to("/bin/sh")
    return root


def test_a_build_for_this_ros_has_not_changed(tmp_path: Path) -> None:
    assert change(tmp_path / "install", "jazzy", root=ros(tmp_path / "ros")) is None
    assert change(build(tmp_path), "jazzy", root=tmp_path / "ros") is None


@pytest.mark.parametrize(
    ("was", "now"),
    [
        (Built("jazzy", "wheels", "3.13"), Built("jazzy", "ros", "3.12")),
        (Built("jazzy", "ros", "3.12"), Built("jazzy", "wheels", "3.13")),
        (Built("humble", "ros", "3.10"), Built("jazzy", "ros", "3.12")),
    ],
)
def test_what_changed_is_named(was: Built, now: Built, tmp_path: Path) -> None:
    install = build(tmp_path, f"/opt/ros/{was.distro}", was.python)
    found = change(install, now.distro, root=ros(tmp_path / "ros", now.distro, now.python))
    assert found is not None
    assert (found.was, found.now) == (was, now)


def test_building_again_is_enough(tmp_path: Path) -> None:
    """Also without deleting install first: then it has both Pythons."""
    install = build(tmp_path, python="3.10")
    root = ros(tmp_path / "ros")
    assert change(install, "jazzy", root=root) is not None
    (install / PACKAGE / "lib" / "python3.12").mkdir()
    assert change(install, "jazzy", root=root) is None


def test_a_script_of_a_python_that_is_gone_is_found(tmp_path: Path) -> None:
    install = build(tmp_path)
    folder = install / PACKAGE / "lib" / PACKAGE
    folder.mkdir()
    for name, line in {
        "gone": "#!/usr/bin/python9.9",
        "here": "#!/bin/sh",
        "env": "#!/usr/bin/env -S sh",
    }.items():
        (folder / name).write_text(f"{line}\n")
        (folder / name).chmod(0o755)
    found = change(install, "jazzy", root=ros(tmp_path / "ros"))
    assert found is not None
    assert (found.script, found.python) == (folder / "gone", "/usr/bin/python9.9")


def test_the_program_of_the_shell_prints_both(tmp_path: Path) -> None:
    """It runs without the grader's environment, at the start of each terminal."""
    install = build(tmp_path, "/opt/ros/humble", "3.10")
    done = processes.run([sys.executable, "-I", "-S", built_for.__file__, install, "nothere"])
    assert done.stdout.splitlines() == [
        "other",
        "ROS 2 humble, Python 3.10",
        "ROS 2 nothere, Python ?",
    ]
