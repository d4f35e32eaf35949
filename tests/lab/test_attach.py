"""`docker exec` and editors that attach find the lab: its lesson, its folder, ROS; they leave nothing."""

from __future__ import annotations

from pathlib import Path

import docker

from tests import processes
from tests.lab.kinds import LABEL, Kind
from tests.lab.screen import Lab

ASKED = 'pwd; echo "$HOME $GRADER_ASSIGNMENT $GRADER_LANG $ROS_DOMAIN_ID"; ros2 pkg prefix rclpy'


def container_of(workspace: Path) -> str:
    client = docker.from_env()
    try:
        (found,) = [
            str(each["Id"])
            for each in client.api.containers(filters={"label": LABEL})
            if any(mount.get("Source") == str(workspace) for mount in each["Mounts"])
        ]
        return found
    finally:
        client.close()


def test_docker_exec_is_another_terminal_of_the_lab(docker_kind: Kind, tmp_path: Path) -> None:
    workspace = tmp_path / "ws"
    env = {
        "GRADER_ASSIGNMENT": "draw_circle",
        "GRADER_LANG": "ko",
        "PIP_INDEX_URL": "http://u:p@h/",
    }
    with Lab(docker_kind, workspace, env=env) as lab:
        expected = lab.type(ASKED).splitlines()
        assert expected[0] == "/home/student/ros2_ws"
        assert expected[1].startswith("/home/student draw_circle ko ")
        lab.type("echo mine > ~/mine")
        exec_ = ["docker", "exec", "-i", container_of(workspace)]
        for words in (["sh", "-c"], ["bash", "-c"], ["bash", "-lic"]):  # (-lic: as VS Code does)
            done = processes.run([*exec_, *words, ASKED])
            assert done.stdout.splitlines() == expected
            assert "rm:" not in done.stderr
        inspected = processes.run(["docker", "inspect", container_of(workspace)])
        assert "http://u:p@h/" not in inspected.stdout
    assert (workspace / ".lab" / "home" / "mine").read_text() == "mine\n"
    assert sorted(path.name for path in (workspace / ".lab").glob("home*")) == ["home"]
