"""The compose and bake files agree with distros.toml, and compose opens the lab."""

from __future__ import annotations

import json
import os
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml
from docker import DockerClient

from grader.ros import image_files
from grader.ros.distro import Distro, distros
from grader.ros.images import image_table
from tests import engine, processes
from tests.docker import checkout

pytestmark = pytest.mark.docker
COMPOSE = "docker/compose.yaml"
PROJECT = f"h{os.getpid()}"
BAKE: dict[str, Any] = json.loads(image_files.BAKE.read_text())
TARGETS: dict[str, Any] = BAKE["target"]
STAGE = re.compile(r"^FROM .* AS (\w+)$", re.MULTILINE)
ARGUMENT = re.compile(r"^ARG (\w+)", re.MULTILINE)


def compose(
    *words: str, folder: Path = processes.ROOT, env: dict[str, str] | None = None
) -> subprocess.CompletedProcess[str]:
    """Run the real docker-compose on a checkout's file."""
    command = ["docker-compose", "-p", PROJECT, "-f", str(folder / COMPOSE), *words]
    return processes.run(command, cwd=folder, env=env, timeout=600)


def service(env: dict[str, str]) -> dict[str, Any]:
    """Return the service `lab` as docker-compose reads it."""
    done = compose("config", env=env)
    assert done.returncode == 0, done.stderr
    found: dict[str, Any] = yaml.safe_load(done.stdout)["services"]["lab"]
    return found


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """A student's workspace."""
    folder = tmp_path / "a workspace"
    folder.mkdir()
    os.chown(folder, 1000, 1000)
    return folder


@pytest.mark.parametrize("name", distros())
def test_compose_builds_and_runs_the_lab_of_each_distro(name: str) -> None:
    lab = service({"DISTRO": name, "WORKSPACE": "/tmp/ws", "GRADER_IMAGES": "some"})
    assert lab["image"] == f"some:lab-{name}"
    assert lab["build"]["args"]["DISTRO"] == name
    assert lab["build"]["target"] == "lab"
    course = f"{processes.ROOT}/lab/course:/opt/ros2_teaching_lab/course:ro"
    assert lab["volumes"] == ["/tmp/ws:/home/student/ros2_ws:rw", course]


def test_compose_opens_the_lab_for_another_courses_lesson() -> None:
    lab = service({"GRADER_COURSE": "/tmp/my course", "GRADER_ASSIGNMENT": "ticking"})
    assert lab["volumes"][1] == "/tmp/my course:/opt/ros2_teaching_lab/course:ro"
    assert lab["environment"]["GRADER_COURSE"] == "/opt/ros2_teaching_lab/course"
    assert lab["environment"]["GRADER_ASSIGNMENT"] == "ticking"


def test_compose_keeps_the_workspace_in_the_home_folder_by_default() -> None:
    lab = service({"HOME": "/home/ann", "WORKSPACE": ""})
    assert lab["volumes"][0] == "/home/ann/ros2_ws:/home/student/ros2_ws:rw"


def test_compose_gives_the_lab_no_privileges() -> None:
    lab = service({})
    assert lab["cap_drop"] == ["ALL"]
    assert lab["security_opt"] == ["no-new-privileges"]
    assert "privileged" not in lab


def test_a_file_made_in_composes_lab_belongs_to_the_student_and_nothing_else_remains(
    client: DockerClient, workspace: Path
) -> None:
    networks = {network.id for network in client.networks.list()}
    create = ("ros2", "pkg", "create", "--build-type", "ament_python", "hello")
    done = compose("run", "--rm", "-T", "lab", *create, env={"WORKSPACE": str(workspace)})
    assert done.returncode == 0, done.stderr
    made = workspace / "hello" / "setup.py"
    assert (made.stat().st_uid, made.stat().st_gid) == (1000, 1000)
    mine = {"label": f"com.docker.compose.project={PROJECT}"}
    assert client.api.containers(all=True, filters=mine) == []
    assert client.api.networks(filters=mine) == []
    assert {network.id for network in client.networks.list()} <= networks
    assert client.volumes.list(filters=mine) == []


def test_a_user_with_another_id_can_use_composes_lab(tmp_path: Path) -> None:
    os.chown(tmp_path, 1234, 1234)
    script = "ros2 pkg create hello && touch ~/mine && echo $HOME"
    env = {"WORKSPACE": str(tmp_path), "LAB_UID": "1234", "LAB_GID": "1234"}
    done = compose("run", "--rm", "-T", "lab", "bash", "-c", script, env=env)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1] == "/home/student"
    assert (tmp_path / "hello" / "package.xml").stat().st_uid == 1234


def test_files_outside_the_workspace_come_back_in_the_next_lab(workspace: Path) -> None:
    def type_(line: str) -> str:
        words = ("run", "--rm", "-T", "lab", "bash", "-ic", line)
        done = compose(*words, env={"WORKSPACE": str(workspace)})
        assert done.returncode == 0, done.stderr
        return done.stdout

    kept = "Your files outside ~/ros2_ws ({}) are kept in ~/ros2_ws/.lab/home"
    said = type_("mkdir ~/notes; echo one > ~/'my file'; echo two > ~/notes/a; touch ~/.hidden")
    assert kept.format("my file notes/a") in said
    said = type_("cat ~/'my file' ~/notes/a; test -e ~/.hidden && rm ~/'my file'")
    assert said.startswith("one\ntwo\n")
    assert kept.format("notes/a") in said
    assert "my file" not in type_("ls ~")
    assert type_("rm -r ~/notes") == ""


@pytest.fixture
def built(client: DockerClient) -> Iterator[str]:
    """The repository for images that a test builds, removed after it."""
    repository = f"{engine.REPOSITORY}-{PROJECT}"
    yield repository
    for image in client.images.list(repository):
        for tag in image.tags:
            if tag.startswith(f"{repository}:"):
                client.images.remove(tag)


@pytest.mark.long
def test_compose_builds_the_lab(client: DockerClient, built: str, tmp_path: Path) -> None:
    folder = checkout.copy_to(tmp_path / "checkout")
    base = {"services": {"lab": {"build": {"args": checkout.ARGUMENTS}}}}
    (folder / "docker" / "base.yaml").write_text(yaml.safe_dump(base))
    words = ("-f", str(folder / "docker" / "base.yaml"), "build", "lab")
    done = compose(*words, folder=folder, env={"GRADER_IMAGES": built})
    assert done.returncode == 0, done.stdout + done.stderr
    image = client.images.get(f"{built}:lab-jazzy")
    assert image.labels["ros2-teaching-lab.stage"] == "lab"
    assert image.labels["ros2-teaching-lab.distro"] == "jazzy"


def test_the_bake_file_agrees_with_distros_toml() -> None:
    assert image_files.BAKE.read_text(encoding="utf-8") == image_files.bake_file()


def test_a_new_distro_needs_only_a_row_in_distros_toml(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    words = ("28.04", "future", "3.15", "90.0", "ros:maritime-ros-base", "https://x/maritime")
    row = Distro("maritime", *words, "FASTDDS_DEFAULT_PROFILES_FILE")
    monkeypatch.setattr(image_files, "distros", lambda: {"maritime": row})
    targets = json.loads(image_files.bake_file())["target"]
    assert set(targets) == {"grade-maritime", "lab-maritime"}
    assert targets["lab-maritime"]["args"]["BASE"] == "ros:maritime-ros-base"


def test_bake_makes_the_images_that_the_grader_looks_for(
    client: DockerClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("GRADER_IMAGES")
    tags = {tag for target in TARGETS.values() for tag in target["tags"]}
    looked_for = {row.name for row in image_table(client)}
    assert looked_for <= tags
    assert {tag for tag in tags - looked_for if ":base-" not in tag} == set()


@pytest.mark.parametrize("name", TARGETS)
def test_a_bake_target_matches_its_dockerfile(name: str) -> None:
    target = TARGETS[name]
    text = (processes.ROOT / target["dockerfile"]).read_text()
    assert target["target"] in STAGE.findall(text)
    assert set(target["args"]) <= set(ARGUMENT.findall(text))
    for context, other in target.get("contexts", {}).items():
        assert target["args"]["BASE"] == context
        assert other.removeprefix("target:") in TARGETS


@pytest.mark.parametrize("name", BAKE["group"])
def test_a_bake_group_names_existing_targets(name: str) -> None:
    assert set(BAKE["group"][name]["targets"]) <= set(TARGETS)
