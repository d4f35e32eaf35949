"""A workspace that was built for another ROS: said on entry, and by every command."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

from grader.ros.prefix import Ros
from lab.other_ros import other_ros
from tests import processes
from tests.lab.kinds import Kind
from tests.lab.screen import Lab

REBUILD = "cd ~/ros2_ws && rm -r build install log && colcon build --symlink-install"
SOLUTION = processes.ROOT / "grader" / "keys" / "hello_time" / "solution"
GONE = "/usr/bin/python3.9"


SCRIPT = "install/my_robot_controller/lib/my_robot_controller/test_node"
RUN = "ros2 run my_robot_controller test_node"


def built(lab: Lab, workspace: Path) -> None:
    """Build the solution in an open lab, and source it."""
    shutil.copytree(SOLUTION, workspace / "src", dirs_exist_ok=True)
    owner = workspace.stat()
    for path in (workspace / "src").rglob("*"):
        os.chown(path, owner.st_uid, owner.st_gid)
    lab.type("colcon build --symlink-install")
    lab.type("source install/local_setup.bash")


def one_line(text: str) -> str:
    """Return a text without its line breaks: the terminal wraps it."""
    return " ".join(text.split())


@pytest.mark.long
def test_a_python_that_is_gone_is_named_everywhere(ros_jazzy: Ros, tmp_path: Path) -> None:
    workspace = tmp_path / "ws"
    named = f"~/ros2_ws/{SCRIPT} cannot start: its first line names {GONE}, which is not here"
    with Lab(Kind("bubblewrap"), workspace) as lab:
        built(lab, workspace)
        assert lab.type("lab doctor && echo well").endswith("well\n")
        lab.type(f"sed -i '1s,.*,#!{GONE},' {SCRIPT}")
        said = lab.type(RUN)
        assert f"names {GONE}, which is not here" in said
        assert REBUILD in said
        assert len(said.splitlines()) == 3
        said = lab.type(f"{RUN} 2>&1 | explain -")
        assert "The installed script names a Python that is not here" in said
        assert said.count(REBUILD) == 2  # of `ros2 run`, and below the explanation
        for command in ("check", "lab check"):
            said = lab.type(command)
            assert f"{named}\n→ {REBUILD}\n" in said
        assert f"wrong {named} → {REBUILD} " in one_line(lab.type("lab doctor"))
        assert lab.status() == 1
        for command in ("guide", "lab status"):
            told = f"Found: {named} Next: {REBUILD} More: lab hint"
            assert told in one_line(lab.type(command))
        assert "Your files in src stay as they are." in one_line(lab.type("lab hint"))
    with Lab(Kind("bubblewrap"), workspace) as lab:
        assert f"test_node cannot start: its first line names {GONE}" in lab.welcome
        assert REBUILD in lab.welcome
        lab.type(REBUILD)
        lab.type("source install/local_setup.bash")
        lab.type(
            "export GRADER_ASSIGNMENT=hello_time"
        )  # (it had full marks: this is the next lesson)
        assert lab.type("lab doctor && echo well").endswith("well\n")
        assert REBUILD not in lab.type("guide")


@pytest.mark.long
def test_a_build_for_another_ros_is_named_everywhere(ros_jazzy: Ros, tmp_path: Path) -> None:
    """As after the official image: that system's Python is here too, but knows no rclpy."""
    workspace = tmp_path / "ws"
    with Lab(Kind("bubblewrap"), workspace) as lab:
        built(lab, workspace)
        lab.type("sed -i 's,/opt/ros/jazzy/bin/python3,/usr/bin/python3,' install/local_setup.sh")
        lab.type(f"sed -i '2i raise ModuleNotFoundError(\"No module named rclpy\")' {SCRIPT}")
        said = lab.type(RUN)
        assert "No module named rclpy" in said
        assert "built for ROS 2 jazzy, Python" in said
        assert REBUILD in said
        was = "your workspace was built for ROS 2 jazzy, Python"
        for command in (f"{RUN} 2>&1 | explain -", "lab check", "lab doctor", "guide"):
            said = one_line(lab.type(command))
            assert said.count(was) == 1, command
            assert REBUILD in said, command
    with Lab(Kind("bubblewrap"), workspace, env={"GRADER_LANG": "ko"}) as lab:
        assert REBUILD in lab.welcome
        lab.type(REBUILD)
        assert REBUILD not in lab.type("bash -i")
        lab.type("exit")
        lab.type("sed -i s,/opt/ros/jazzy,/opt/ros/humble, install/setup.sh")
        said = lab.type("bash -i")
        assert "ROS 2 humble" in said
        assert REBUILD in said


def test_outside_of_a_lab_nothing_is_known_of_a_build(tmp_path: Path) -> None:
    """There the Python of the lab is not, and that is right so."""
    script = tmp_path / SCRIPT
    script.parent.mkdir(parents=True)
    script.write_text("#!/opt/ros/nothere/bin/python3\n")
    script.chmod(0o755)
    (tmp_path / "install" / "setup.sh").write_text('COLCON_CURRENT_PREFIX="/opt/ros/nothere"\n')
    assert other_ros(tmp_path, {"ROS_DISTRO": "nothere"}) is None
