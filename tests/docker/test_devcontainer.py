"""The dev container starts with the `devcontainer` command and contains the lab."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import docker
import pytest

from grader.ros.distro import distros
from tests import processes
from tests.docker import checkout, devcontainer_cli

pytestmark = pytest.mark.docker
CONFIG = ".devcontainer/devcontainer.json"
NAME = f"ros2-teaching-lab-tests-{os.getpid()}"
Inside = Callable[..., subprocess.CompletedProcess[str]]


def configuration(*variables: str) -> dict[str, Any]:
    """Return the configuration as the command reads it, with variables substituted."""
    words = ["read-configuration", "--workspace-folder", str(processes.ROOT)]
    done = processes.run(["env", "-u", "DISTRO", *variables, *devcontainer_cli.command(), *words])
    assert done.returncode == 0, done.stderr
    read: dict[str, Any] = json.loads(done.stdout)["configuration"]
    return read


@pytest.fixture(scope="module")
def inside(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Inside]:
    """A function that runs a command in the dev container, built from the stand-in image."""
    folder = checkout.copy_to(tmp_path_factory.mktemp("dev") / NAME)
    own = json.loads((folder / CONFIG).read_text())
    own["build"]["args"].update(checkout.ARGUMENTS)
    own["workspaceMount"] = own["workspaceMount"].replace("source=ros2_ws", f"source={NAME}")
    assert NAME in own["workspaceMount"]  # never the user's volume
    (folder / CONFIG).write_text(json.dumps(own))
    cli = devcontainer_cli.command()
    mine = ["--workspace-folder", str(folder), "--id-label", f"tests={NAME}"]
    try:
        made = processes.run([*cli, "up", *mine, "--buildkit", "never"], timeout=600)
        assert made.returncode == 0, made.stdout[-2000:] + made.stderr[-4000:]
        yield lambda *words: processes.run([*cli, "exec", *mine, *words], timeout=300)
    finally:
        clear_away()


def clear_away() -> None:
    """Remove the container, its images and its volume."""
    client = docker.from_env()
    for container in client.containers.list(all=True, filters={"label": f"tests={NAME}"}):
        container.remove(force=True)
    for image in client.images.list():
        for tag in image.tags:
            if tag.startswith(f"vsc-{NAME}"):
                client.images.remove(tag)
    for volume in client.volumes.list(filters={"name": NAME}):
        volume.remove()
    client.close()


def test_ros_and_colcon_answer_in_every_shell(inside: Inside) -> None:
    done = inside("bash", "-ic", "ros2 pkg prefix rclpy && colcon --help")
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("/opt/ros/jazzy\n")
    assert "colcon [-h]" in done.stdout


def test_its_user_is_the_student_in_their_own_workspace(inside: Inside) -> None:
    done = inside("bash", "-c", "id -un; pwd; touch src/mine && stat -c %U src/mine")
    assert done.stdout.splitlines() == ["student", "/home/student/ros2_ws", "student"]


def test_nobody_can_become_root(inside: Inside) -> None:
    done = inside("grep", "NoNewPrivs", "/proc/self/status")
    assert done.stdout.split() == ["NoNewPrivs:", "1"]


def test_the_guide_and_the_check_are_available(inside: Inside) -> None:
    done = inside("bash", "-ic", "command -v guide check")
    assert [Path(line).name for line in done.stdout.split()] == ["guide", "check"]


@pytest.mark.parametrize("name", distros())
def test_distro_in_the_environment_chooses_another(name: str) -> None:
    assert configuration(f"DISTRO={name}")["build"]["args"]["DISTRO"] == name


def test_jazzy_is_the_default() -> None:
    assert configuration()["build"]["args"]["DISTRO"] == "jazzy"


def test_its_base_is_the_official_image_of_the_distro(tmp_path: Path) -> None:
    """No registry is reachable here; the command names the image that it would pull."""
    folder = checkout.copy_to(tmp_path / "checkout")
    words = ["up", "--workspace-folder", str(folder), "--id-label", f"tests={NAME}-none"]
    docker_path = tmp_path / "docker"
    docker_path.write_text('#!/bin/sh\ncase "$1" in pull) echo "$2" >> "$PULLED"; exit 1 ;; esac\n'
                           'exec docker "$@"\n')  # fmt: skip
    docker_path.chmod(0o755)
    pulled = tmp_path / "pulled"
    words += ["--buildkit", "never", "--docker-path", str(docker_path)]
    env = {"DISTRO": "humble", "PULLED": str(pulled)}
    processes.run([*devcontainer_cli.command(), *words], env=env)
    assert set(pulled.read_text().split()) == {"ros:humble-ros-base"}
