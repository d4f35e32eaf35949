"""Terminals in every kind of lab: keys, sizes, completion, and a second terminal."""

from __future__ import annotations

import re
import secrets
from pathlib import Path

import pexpect

from tests import processes
from tests.domains import new_domain
from tests.lab.helpers import SLOW, has_the_terminal, start, until
from tests.lab.kinds import Kind
from tests.lab.screen import Lab, command, environment

NODE = "import rclpy; rclpy.init(); rclpy.spin(rclpy.create_node('talker'))"
SEEN = "timeout 60 bash -c 'until ros2 node list | grep -x /talker; do :; done'"


def test_the_welcome_is_shown_once(kind: Kind, tmp_path: Path) -> None:
    with Lab(kind, tmp_path / "ros2_ws") as lab:
        for word in ("ROS 2 jazzy", str(tmp_path / "ros2_ws"), "guide", "check", "exit"):
            assert word in lab.welcome
        assert lab.type("pwd").strip() == "/home/student/ros2_ws"
        assert "ROS 2" not in lab.type("bash")
        assert lab.type("source ~/.bashrc; true").strip() in ("", _missing(lab))


def _missing(lab: Lab) -> str:
    """Return bash's message if the image has no ~/.bashrc but only /etc/bash.bashrc."""
    return "bash: /home/student/.bashrc: No such file or directory"


def test_the_tutorials_first_command_works_and_changes_nothing(kind: Kind, tmp_path: Path) -> None:
    with Lab(kind, tmp_path / "ros2_ws") as lab:
        before = lab.type("env | grep -v ^_ | sort")
        assert lab.type("source /opt/ros/jazzy/setup.bash") == ""
        assert lab.type("env | grep -v ^_ | sort") == before
        assert "ros2_ws" not in lab.type("echo $AMENT_PREFIX_PATH")  # not sourced automatically


def test_ctrl_c_reaches_the_running_command_and_leaves_the_lab_open(
    kind: Kind, tmp_path: Path
) -> None:
    with Lab(kind, tmp_path / "ros2_ws") as lab:
        start(lab, "sleep 1000")
        lab.interrupt()
        assert lab.status() == 130
        lab.screen.sendintr()  # at an empty prompt
        lab.screen.sendline()  # wakes readline if Ctrl+C came just before it slept
        lab.screen.sendline("echo still $((40 + 2))")
        lab.screen.expect_exact("still 42")
        assert lab.leave() == 0


def test_ctrl_z_stops_a_command_and_fg_resumes_it(kind: Kind, tmp_path: Path) -> None:
    with Lab(kind, tmp_path / "ros2_ws") as lab:
        mark = f"sleep 90{secrets.randbelow(10**6)}"
        start(lab, mark)
        until(lambda: has_the_terminal(mark))
        lab.screen.sendcontrol("z")
        assert "Stopped" in lab.wait_for_prompt()
        assert "Stopped" in lab.type("jobs")
        lab.screen.sendline("fg")
        until(lambda: has_the_terminal(mark))
        lab.interrupt()
        assert lab.status() == 130


def test_the_window_size_follows_the_terminal(kind: Kind, tmp_path: Path) -> None:
    with Lab(kind, tmp_path / "ros2_ws") as lab:
        size = """timeout 20 bash -c 'until [ "$(stty size)" = "%s" ]; do :; done'; echo met $?"""
        lab.screen.sendline(size % "40 200")
        lab.screen.expect("met 0")
        lab.screen.setwinsize(33, 150)
        lab.screen.sendline(size % "33 150")
        lab.screen.expect("met 0")


def test_tab_completes_commands_verbs_and_packages(kind: Kind, tmp_path: Path) -> None:
    with Lab(kind, tmp_path / "ros2_ws") as lab:
        for typed, rest in (
            ("ros2 ru\t", "ros2 run "),
            ("ros2 pkg cre\t", "ros2 pkg create "),
            ("ros2 run rosidl_ad\t", "ros2 run rosidl_adapter "),
            ("colcon bu\t", "colcon build "),
        ):
            lab.screen.send(typed)
            lab.screen.expect_exact(rest)
            # no Ctrl+C: readline misses a signal between drawing a line and the next read
            lab.screen.sendcontrol("u")


def test_a_second_terminal_sees_the_nodes_of_the_first(kind: Kind, tmp_path: Path) -> None:
    env = {"ROS_DOMAIN_ID": new_domain()}
    workspace = tmp_path / "ros2_ws"
    with Lab(kind, workspace, env=env) as first, Lab(kind, workspace, env=env) as second:
        first.screen.sendline(f'python3 -c "{NODE}"')
        assert "/talker" in second.type(SEEN)
        assert second.type("touch made_in_the_second; echo $ROS_AUTOMATIC_DISCOVERY_RANGE").split()
        first.interrupt()
        assert "made_in_the_second" in first.type("ls")
        assert second.leave() == 0
        assert first.type("echo the first stays").strip() == "the first stays"
        assert first.leave() == 0


def test_ctrl_c_reaches_a_command_run_on_the_terminal(kind: Kind, tmp_path: Path) -> None:
    script = "trap 'echo last words; exit 5' INT; echo up; while :; do sleep 0.1; done"
    words = command("--sandbox", kind.sandbox, "--workspace", tmp_path / "ws", "--")
    screen = pexpect.spawn(
        words[0],
        [*words[1:], "bash", "-c", script],
        cwd=str(processes.ROOT),
        env=environment(**kind.env),
        encoding="utf-8",
        timeout=SLOW,
    )
    screen.expect_exact("up\r\n")
    screen.sendintr()
    screen.expect_exact("last words")
    screen.expect(pexpect.EOF)
    screen.close()
    assert screen.exitstatus == 5


def test_a_hostile_name_is_shown_literally_in_the_welcome(kind: Kind, tmp_path: Path) -> None:
    with Lab(kind, tmp_path / "$(echo run)") as lab:
        assert re.search(r"\\\$\\\(echo\\ run\\\)", lab.welcome)
