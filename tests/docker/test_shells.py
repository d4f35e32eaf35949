"""ROS is there in every shell and for every command of the images, however it is started."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator

import pytest

from tests import engine, processes

pytestmark = [pytest.mark.docker]
LAB = f"{engine.REPOSITORY}:lab-jazzy"
GRADE = f"{engine.REPOSITORY}:grade-jazzy"
PREFIX = ["ros2", "pkg", "prefix", "rclpy"]
WAYS: dict[str, list[str]] = {
    "the command": PREFIX,
    "bash -c": ["bash", "-c", " ".join(PREFIX)],
    "bash -lc": ["bash", "-lc", " ".join(PREFIX)],
    "bash -ic": ["bash", "-ic", " ".join(PREFIX)],
    "sh -c": ["sh", "-c", " ".join(PREFIX)],
    "sh -lc": ["sh", "-lc", " ".join(PREFIX)],
    "python3": ["python3", "-c", "import rclpy.node; rclpy.init(); print('/opt/ros/jazzy')"],
    "login without variables": ["env", "-i", "sh", "-lc", " ".join(PREFIX)],
}


def docker(*words: str) -> subprocess.CompletedProcess[str]:
    return processes.run(["docker", *words], timeout=60)


@pytest.fixture(scope="module", params=[LAB, GRADE])
def container(request: pytest.FixtureRequest) -> Iterator[str]:
    """A container of an image, kept with a terminal as people do for `docker exec`."""
    name = docker("run", "-dit", request.param).stdout.strip()
    yield name
    docker("rm", "-f", name)


@pytest.mark.parametrize("way", WAYS)
def test_docker_exec_finds_ros(container: str, way: str) -> None:
    done = docker("exec", container, *WAYS[way])
    assert (done.returncode, done.stdout) == (0, "/opt/ros/jazzy\n"), done.stderr


def test_ros_is_set_up_as_its_own_script_does(container: str) -> None:
    """Sourced by a student once more, it adds nothing; and no link is in what a shell shows."""
    variables = "echo $AMENT_PREFIX_PATH $PYTHONPATH $LD_LIBRARY_PATH; echo $PATH"
    script = f"{variables}; . /opt/ros/jazzy/setup.bash; {variables}"
    once = docker("exec", container, "bash", "-c", script).stdout.splitlines()
    assert once[:2] == once[2:]
    own = f"unset PYTHONPATH LD_LIBRARY_PATH; . /opt/ros/jazzy/setup.bash; {variables}"
    assert docker("exec", container, "bash", "-c", own).stdout.splitlines() == once[:2]


def test_the_labs_commands_are_in_every_shell() -> None:
    script = "guide --help && check --help && ros2 lab --help && ros2 topic list"
    done = docker("run", "--rm", LAB, "sh", "-c", script)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.splitlines()[-2:] == ["/parameter_events", "/rosout"]


def test_the_entry_point_sources_the_overlay_but_not_for_a_person() -> None:
    """`docker run IMAGE ros2 run …` finds the workspace's packages; a shell has to source them."""
    build = (
        "mkdir -p ~/ros2_ws/install && cd ~/ros2_ws && "
        "echo 'export AMENT_PREFIX_PATH=/mine:$AMENT_PREFIX_PATH' > install/local_setup.bash; "
        '"$0" printenv AMENT_PREFIX_PATH; "$0" bash -c "printenv AMENT_PREFIX_PATH"; '
        'echo "printenv AMENT_PREFIX_PATH" | "$0" bash'
    )
    done = docker("run", "--rm", LAB, "bash", "-c", build, "/opt/ros/image/entrypoint")
    sourced = "/mine:/opt/ros/jazzy"
    assert done.stdout.splitlines() == [sourced, sourced, "/opt/ros/jazzy"], done.stderr


@pytest.mark.parametrize("image", [LAB, GRADE])
def test_a_shell_without_a_terminal_says_so(image: str) -> None:
    done = docker("run", "--rm", image)
    assert done.returncode == 2
    assert "docker run -it IMAGE" in done.stderr
