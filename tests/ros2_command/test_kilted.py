"""What ros2cli 0.38 (kilted) does differently."""

from __future__ import annotations

import os
import re
import select
import signal
import subprocess
import sys

import pexpect
import pytest

from grader.sandbox.processes import children_of
from tests.processes import wait_until_asleep

from .surroundings import Surroundings, files

pytestmark = pytest.mark.full  # it makes another prefix
CREATE = ("pkg", "create", "--build-type", "ament_python", "my_robot_controller")
# Prints each SIGINT and SIGTERM, and ends at SIGTERM
LISTENER = f"""\
#!{sys.executable}
import os, signal, sys
def heard(number):
    os.write(1, f"heard {{signal.Signals(number).name}}\\n".encode())
    if number == signal.SIGTERM:
        sys.exit(5)
signals = [signal.SIGINT, signal.SIGTERM]
signal.pthread_sigmask(signal.SIG_BLOCK, signals)
print("ready", flush=True)
while True:
    heard(signal.sigwait(signals))
"""


@pytest.fixture
def started(kilted: Surroundings) -> subprocess.Popen[str]:
    kilted.add_executable("listener", LISTENER)
    process = subprocess.Popen(
        [kilted.prefix / "bin" / "ros2", "run", "my_robot_controller", "listener"],
        env=kilted.environment,
        stdout=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    assert process.stdout is not None
    assert process.stdout.readline() == "ready\n"
    return process


def test_signals_to_ros2_alone_are_forwarded(started: subprocess.Popen[str]) -> None:
    assert started.stdout is not None
    os.kill(started.pid, signal.SIGINT)
    lines = {started.stdout.readline() for _ in range(2)}
    assert lines == {"[ros2run]: Received signal:  Interrupt\n", "heard SIGINT\n"}

    os.kill(started.pid, signal.SIGTERM)
    assert started.wait(30) == 5
    assert sorted(started.stdout.read().splitlines()) == [
        "[ros2run]: Process exited with failure 5",
        "[ros2run]: Received signal:  Terminated",
        "heard SIGTERM",
    ]


def test_a_signal_that_comes_while_another_is_told_is_forwarded_too(
    started: subprocess.Popen[str],
) -> None:
    assert started.stdout is not None
    for _ in range(500):  # each as soon as the one before is told
        os.kill(started.pid, signal.SIGINT)
        assert select.select([started.stdout], [], [], 30)[0]
        os.read(started.stdout.fileno(), 4096)
    os.kill(started.pid, signal.SIGTERM)
    assert started.wait(30) == 5


def test_a_node_ended_by_sigint_gives_status_254(kilted: Surroundings) -> None:
    terminal: pexpect.spawn[str] = pexpect.spawn(
        str(kilted.prefix / "bin" / "ros2"),
        ["run", "my_robot_controller", "hang"],
        env=kilted.environment,
        encoding="utf-8",
        timeout=30,
    )
    terminal.expect_exact("hanging")
    for process in (terminal.pid, *children_of(terminal.pid)):
        wait_until_asleep(process)
    os.kill(terminal.pid, signal.SIGINT)
    terminal.expect(pexpect.EOF)
    output = terminal.before or ""
    terminal.wait()
    assert terminal.exitstatus == 254
    assert output.count("[ros2run]: Received signal:  Interrupt\r\n") == 1
    assert output.endswith("[ros2run]: Interrupt\r\n")


def test_ctrl_c_on_the_terminal_reaches_the_node_and_is_forwarded_too(kilted: Surroundings) -> None:
    kilted.add_executable("listener", LISTENER)
    terminal: pexpect.spawn[str] = pexpect.spawn(
        str(kilted.prefix / "bin" / "ros2"),
        ["run", "my_robot_controller", "listener"],
        env=kilted.environment,
        encoding="utf-8",
        timeout=30,
    )
    terminal.expect_exact("ready")
    terminal.sendintr()
    terminal.expect_exact("[ros2run]: Received signal:  Interrupt")
    output = terminal.before or ""
    os.kill(terminal.pid, signal.SIGTERM)
    terminal.expect(pexpect.EOF)
    output += terminal.before or ""
    terminal.wait()
    assert terminal.exitstatus == 5
    # The two merge into one if the second comes before the node is scheduled
    assert output.count("heard SIGINT") in (1, 2)


def test_a_new_package_is_checked_with_xmllint_too(kilted: Surroundings) -> None:
    done = kilted.ros2(*CREATE)
    assert done.status == 0
    assert "creating ./my_robot_controller/test/test_xmllint.py\n" in done.stdout
    folder = kilted.root / "my_robot_controller"
    depends = re.findall(r"<test_depend>(\w[\w-]*)<", (folder / "package.xml").read_text())
    assert depends == [
        "ament_copyright",
        "ament_flake8",
        "ament_pep257",
        "ament_xmllint",
        "python3-pytest",
    ]
    assert files(folder)["test/test_xmllint.py"]["mode"] == "0o644"


def test_setup_py_has_pytest_as_an_extra(kilted: Surroundings) -> None:
    kilted.ros2(*CREATE)
    setup = files(kilted.root / "my_robot_controller")["setup.py"]["setup_arguments"]
    assert isinstance(setup, dict)
    assert setup["extras_require"] == "{'test': ['pytest']}"
    assert "tests_require" not in setup


@pytest.mark.parametrize(
    ("distro", "maintainer"),
    [("kilted", "Ann Lee <ann@example.org>"), ("jazzy", "student <ann@example.org>")],
)
def test_git_names_the_maintainer(kilted: Surroundings, distro: str, maintainer: str) -> None:
    config = kilted.root / "home" / ".gitconfig"
    config.write_text("[user]\n  name = Ann Lee\n  email = ann@example.org\n")
    done = kilted.ros2(*CREATE, environment={"ROS_DISTRO": distro})
    assert f"maintainer: ['{maintainer}']\n" in done.stdout


def test_the_login_name_is_used_without_git_settings(kilted: Surroundings) -> None:
    done = kilted.ros2(*CREATE)
    assert "maintainer: ['student <student@todo.todo>']\n" in done.stdout


def test_the_prefix_names_its_distro_if_the_environment_does_not(kilted: Surroundings) -> None:
    (kilted.prefix / "lib" / "site" / "wheels_ros2" / "distro").write_text("kilted\n")
    kilted.ros2(*CREATE, environment={"ROS_DISTRO": ""})
    assert (kilted.root / "my_robot_controller" / "test" / "test_xmllint.py").exists()


def test_without_either_it_is_jazzy(kilted: Surroundings) -> None:
    kilted.ros2(*CREATE, environment={"ROS_DISTRO": ""})
    assert not (kilted.root / "my_robot_controller" / "test" / "test_xmllint.py").exists()


def test_ament_cmake_links_targets(kilted: Surroundings) -> None:
    kilted.ros2("pkg", "create", "p1", "--node-name", "n", "--dependencies", "rclcpp")
    text = (kilted.root / "p1" / "CMakeLists.txt").read_text()
    assert "cmake_minimum_required(VERSION 3.20)" in text
    assert "target_link_libraries(n PUBLIC\n  ${rclcpp_TARGETS})" in text
    assert "ament_target_dependencies" not in text
