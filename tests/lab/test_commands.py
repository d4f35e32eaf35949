"""A command run in the lab instead of a shell, the same in every kind of lab."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tests.lab.helpers import run
from tests.lab.kinds import Kind


def test_nodes_stay_on_this_machine_by_default(kind: Kind, tmp_path: Path) -> None:
    asked = ("--", "bash", "-c", "echo $ROS_AUTOMATIC_DISCOVERY_RANGE")
    assert run(kind, tmp_path / "ws", *asked).stdout == "LOCALHOST\n"
    wide = Kind(kind.sandbox, {**kind.env, "ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"})
    assert run(wide, tmp_path / "ws", *asked).stdout == "SUBNET\n"


@pytest.mark.parametrize(
    ("script", "status"),
    [("exit 0", 0), ("exit 7", 7), ("no-such-command", 127), ("kill -9 $$", 137)],
)
def test_the_lab_exits_with_the_commands_status(
    script: str, status: int, kind: Kind, tmp_path: Path
) -> None:
    assert run(kind, tmp_path / "ws", "--", "bash", "-c", script).returncode == status


def test_a_commands_stdout_and_stderr_are_separate_and_complete(kind: Kind, tmp_path: Path) -> None:
    script = "echo first >&2; seq 100000; echo last >&2"
    done = run(kind, tmp_path / "ws", "--", "bash", "-c", script)
    assert done.stdout.split() == [str(number) for number in range(1, 100_001)]
    assert [line for line in done.stderr.splitlines() if "lab: " not in line] == ["first", "last"]


def test_a_script_on_standard_input_is_run_with_ros(kind: Kind, tmp_path: Path) -> None:
    done = run(kind, tmp_path / "ws", stdin="cat /proc/version > v\nros2 pkg list\nexit 4\n")
    assert done.returncode == 4
    assert "rclpy" in done.stdout.split()
    assert "guide" not in done.stdout  # no welcome
    assert (tmp_path / "ws" / "v").read_text() == Path("/proc/version").read_text()


def test_the_home_folder_is_kept_and_is_no_loop(kind: Kind, tmp_path: Path) -> None:
    script = "mkdir ~/notes && echo mine > ~/notes/a && echo 'alias a=b' >> ~/.bashrc && find ~"
    first = run(kind, tmp_path / "ws", "--", "bash", "-c", script)
    assert (first.returncode, first.stderr.count("loop")) == (0, 0), first.stderr
    again = run(kind, tmp_path / "ws", "--", "bash", "-c", "cat ~/notes/a; tail -1 ~/.bashrc")
    assert again.stdout == "mine\nalias a=b\n"


def test_the_student_is_not_root_and_has_no_privileges(kind: Kind, tmp_path: Path) -> None:
    script = "id -u; grep -E 'CapEff|CapPrm|CapBnd|NoNewPrivs' /proc/self/status"
    uid, *lines = run(kind, tmp_path / "ws", "--", "bash", "-c", script).stdout.splitlines()
    assert int(uid) == (os.geteuid() or 1000)
    values = dict(line.split(":\t") for line in lines)
    assert int(values["CapEff"], 16) == int(values["CapPrm"], 16) == 0
    assert values["NoNewPrivs"] == "1"


def test_the_lab_has_no_solutions_and_no_secrets_of_the_caller(
    kind: Kind, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SECRET_TOKEN", "abc")
    script = "env; ls -A /opt/ros2_teaching_lab/grader/keys; find /opt /home -name 'hidden.yaml' -o -name solution"
    done = run(kind, tmp_path / "ws", "--", "bash", "-c", script)
    assert done.returncode == 0
    assert "ROS_DISTRO=jazzy" in done.stdout
    assert "SECRET_TOKEN" not in done.stdout
    assert not [line for line in done.stdout.splitlines() if "=" not in line]


HOSTILE = ["a b; touch HACKED", 'it\'s "quoted"', "$(touch HACKED)", "-x", "col:on,comma", "한국어"]


@pytest.mark.parametrize("name", HOSTILE)
def test_a_workspaces_name_is_data(name: str, kind: Kind, tmp_path: Path) -> None:
    workspace = tmp_path / name
    done = run(kind, workspace, "--", "touch", "src/here")
    assert done.returncode == 0, done.stderr
    found = [str(path.relative_to(tmp_path)) for path in sorted(tmp_path.rglob("*"))]
    assert [path for path in found if not path.startswith(f"{name}/.lab")] == [
        name,
        f"{name}/src",
        f"{name}/src/here",
    ]
