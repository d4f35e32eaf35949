"""What a machine shows is told beside the explanation: its ROS, its workspace, its Python."""

from __future__ import annotations

import io
import os
import sys
from pathlib import Path

import pytest

from grader.explain.explanation import Reader, print_recognised
from grader.explain.machine import Machine
from grader.ros.distro import find_distro


@pytest.fixture
def home(tmp_path: Path) -> Path:
    """A person's files: ROS below opt/ros, and a workspace with a package that was built."""
    for name in ("opt/ros/humble", "etc", "home/ros2_ws/src/rover", "bin"):
        (tmp_path / name).mkdir(parents=True)
    (tmp_path / "opt/ros/humble/setup.bash").write_text("")
    (tmp_path / "etc/os-release").write_text('NAME="Ubuntu"\nPRETTY_NAME="Ubuntu 22.04.4 LTS"\n')
    programs = tmp_path / "home/ros2_ws/install/rover/lib/rover"
    programs.mkdir(parents=True)
    for name in ("drive", "stop"):
        (programs / name).write_text("#!/usr/bin/python3\n")
        (programs / name).chmod(0o755)
    return tmp_path


def machine(home: Path, **environment: str) -> Machine:
    variables = {"HOME": str(home / "home"), **environment}
    return Machine(variables, home / "home/ros2_ws/src", home)


def answer(text: str, machine: Machine) -> str:
    out = io.StringIO()
    print_recognised(text, file=out, reader=Reader("en", machine.distro, machine=machine))
    return " ".join(out.getvalue().split())


def test_the_distro_is_the_one_that_is_installed_if_none_is_sourced(home: Path) -> None:
    assert machine(home).distro.name == "humble"
    assert machine(home, ROS_DISTRO="kilted").distro.name == "kilted"
    said = answer("bash: ros2: command not found", machine(home))
    assert "/opt/ros has humble, and none is sourced here." in said
    assert "source /opt/ros/humble/setup.bash" in said


def test_how_far_the_package_has_come(home: Path) -> None:
    built = home / "home/ros2_ws/install/rover"
    assert "ros2_ws/install has no rovr" in answer("Package 'rovr' not found", machine(home))
    text = "Package 'rover' not found"
    assert "this terminal has not sourced it" in answer(text, machine(home))
    sourced = machine(home, AMENT_PREFIX_PATH=f"{built}:/opt/ros/humble")
    assert "rover is built, and sourced in this terminal" in answer(text, sourced)


def test_the_executables_of_the_package_are_listed(home: Path) -> None:
    (home / "home/ros2_ws/install/rover/lib/rover/stop").chmod(0o644)
    said = answer("$ ros2 run rover dirve\nNo executable found\n", machine(home))
    assert "rover has these executables: drive." in said


@pytest.mark.parametrize(
    ("variables", "says"),
    [
        ({"CONDA_DEFAULT_ENV": "base"}, "The conda environment base is active"),
        ({"VIRTUAL_ENV": "/home/kim/venv"}, "The venv /home/kim/venv is active"),
    ],
)
def test_the_python_of_the_terminal(home: Path, variables: dict[str, str], says: str) -> None:
    text = "ModuleNotFoundError: No module named 'rclpy._rclpy_pybind11'"
    assert says in answer(text, machine(home, **variables))


def test_the_settings_of_the_graph_are_shown(home: Path) -> None:
    said = answer("Node not found", machine(home, ROS_DOMAIN_ID="7"))
    assert "This terminal has ROS_DOMAIN_ID=7. The other one must have the same." in said
    assert "must have the same" not in answer("Node not found", machine(home))


def test_the_release_of_the_system(home: Path) -> None:
    said = answer("E: Unable to locate package ros-jazzy-desktop", machine(home))
    assert "This is Ubuntu 22.04.4 LTS." in said


def _python_with_setuptools(home: Path, version: str) -> str:
    """Put a real Python that finds this version of setuptools into PATH; return the PATH."""
    modules = home / "modules"
    info = modules / f"setuptools-{version}.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: setuptools\nVersion: {version}\n")
    program = home / "bin/python3"
    program.write_text(f'#!/bin/sh\nPYTHONPATH={modules} exec {sys.executable} "$@"\n')
    program.chmod(0o755)
    return f"{home / 'bin'}:{os.environ['PATH']}"


@pytest.mark.parametrize(
    ("version", "linked", "told"), [("82.0.1", False, True), ("68.1.2", False, False),
                                    ("82.0.1", True, False)],
)  # fmt: skip
def test_files_that_symlink_install_has_copied_are_found(
    home: Path, version: str, *, linked: bool, told: bool
) -> None:
    """colcon itself prints nothing of it: what was installed decides."""
    folder = home / "home/ros2_ws/install/rover/lib/python3.12/site-packages/rover"
    folder.mkdir(parents=True)
    source = home / "home/ros2_ws/src/rover/drive.py"
    source.write_text("")
    if linked:
        (folder / "drive.py").symlink_to(source)
    else:
        (folder / "drive.py").write_text("")
    text = (
        "$ colcon build --symlink-install\nStarting >>> rover\nFinished <<< rover [1.2s]\n\n"
        "Summary: 1 package finished [1.4s]\n"
    )
    said = answer(text, machine(home, PATH=_python_with_setuptools(home, version)))
    assert ("lab.copied_here" in said) is told
    assert ("setuptools is 82.0.1 here, and the files of rover were copied." in said) is told


def test_a_machine_that_shows_nothing_changes_nothing(tmp_path: Path) -> None:
    bare = Machine({}, tmp_path, tmp_path)
    out = io.StringIO()
    reader = Reader("en", find_distro("jazzy"), machine=bare)
    print_recognised("Package 'rover' not found", file=out, reader=reader)
    assert " here " not in out.getvalue()
