"""What `ros2 run` does beyond the recordings."""

from __future__ import annotations

import os
import signal
import sys

import pytest

from grader.explain import from_terminal

from .surroundings import Surroundings, add_marker, write_script

MOST_STARTS = 8  # of Python, that `ros2 run` may cost (measured: 4.5)
SAY_WHERE = '#!/bin/sh\necho "$0" "$@"\n'


def test_executables_are_found_in_folders_below(jazzy: Surroundings) -> None:
    path = write_script(jazzy.executables / "tools" / "deep" / "below", SAY_WHERE)
    done = jazzy.ros2("run", "my_robot_controller", "below")
    assert (done.status, done.stdout) == (0, f"{path}\n")


def test_hidden_folders_are_not_searched(jazzy: Surroundings) -> None:
    write_script(jazzy.executables / ".cache" / "hidden", SAY_WHERE)
    done = jazzy.ros2("run", "my_robot_controller", "hidden")
    assert (done.status, done.stderr) == (1, "No executable found\n")


def test_only_the_exact_name_is_found(jazzy: Surroundings) -> None:
    jazzy.add_executable("test_node.py", SAY_WHERE)
    done = jazzy.ros2("run", "my_robot_controller", "test_node")
    assert (done.status, done.stderr) == (1, "No executable found\n")


def test_two_executables_with_one_name_are_listed_and_none_is_run(jazzy: Surroundings) -> None:
    first = write_script(jazzy.executables / "a" / "twin", SAY_WHERE)
    second = write_script(jazzy.executables / "b" / "twin", SAY_WHERE)
    done = jazzy.ros2("run", "my_robot_controller", "twin")
    assert (done.status, done.stdout) == (1, "")
    assert done.stderr == f"Multiple executables found:\n- {first}\n- {second}\n"


def test_a_dangling_marker_is_not_a_package(jazzy: Surroundings) -> None:
    marker = add_marker(jazzy.overlay, "moved_away")
    marker.unlink()
    marker.symlink_to(jazzy.root / "nowhere")
    done = jazzy.ros2("run", "moved_away", "x")
    assert (done.status, done.stderr) == (1, "Package 'moved_away' not found\n")


@pytest.mark.parametrize("name", ["my robot", "../my_robot_controller", "x", ""])
def test_an_impossible_package_name_is_not_found(jazzy: Surroundings, name: str) -> None:
    done = jazzy.ros2("run", name, "x")
    assert (done.status, done.stderr) == (1, f"Package '{name}' not found\n")


def test_the_overlay_comes_before_the_underlay(jazzy: Surroundings) -> None:
    add_marker(jazzy.prefix, "my_robot_controller")
    write_script(jazzy.prefix / "lib" / "my_robot_controller" / "only_below", SAY_WHERE)
    done = jazzy.ros2("run", "my_robot_controller", "only_below")
    assert (done.status, done.stderr) == (1, "No executable found\n")


def test_a_bad_prefix_program_is_a_traceback(jazzy: Surroundings) -> None:
    done = jazzy.ros2("run", "--prefix", "no_such_program -x", "my_robot_controller", "zero")
    assert done.status == 1
    assert done.stderr.startswith("Traceback (most recent call last):\n")
    assert done.stderr.endswith(
        "FileNotFoundError: [Errno 2] No such file or directory: 'no_such_program'\n"
    )


def test_a_script_whose_python_is_gone_is_told_with_the_remedy(jazzy: Surroundings) -> None:
    """The workspace was built in another lab: the real command has a traceback of 30 lines."""
    jazzy.add_executable("moved", "#!/opt/ros/jazzy/bin/python9\n")
    done = jazzy.ros2("run", "my_robot_controller", "moved")
    assert (done.status, done.stdout) == (1, "")
    assert len(done.stderr.splitlines()) == 3
    assert "lib/my_robot_controller/moved cannot start" in done.stderr
    assert "/opt/ros/jazzy/bin/python9, which is not here" in done.stderr
    assert "rm -r build install log && colcon build --symlink-install" in done.stderr
    seen = from_terminal.seen_in(done.stderr)
    assert [each.kind.id for each in seen] == ["lab.python_gone"]


def test_without_a_sourced_environment_it_names_the_variable(jazzy: Surroundings) -> None:
    done = jazzy.ros2("run", "rclpy", "x", environment={"AMENT_PREFIX_PATH": ""})
    assert done.status == 1
    assert done.stderr.endswith(
        "OSError: Environment variable 'AMENT_PREFIX_PATH' is not set or empty\n"
    )


def test_missing_prefixes_are_skipped(jazzy: Surroundings) -> None:
    path = f"/nowhere:{jazzy.environment['AMENT_PREFIX_PATH']}:"
    done = jazzy.ros2("run", "my_robot_controller", "zero", environment={"AMENT_PREFIX_PATH": path})
    assert (done.status, done.stdout) == (0, "[]\n")


@pytest.mark.parametrize(
    ("number", "status", "line"),
    [(signal.SIGKILL, 247, "Killed"), (signal.SIGSEGV, 245, "Segmentation fault")],
)
def test_a_child_killed_by_a_signal(
    jazzy: Surroundings, number: int, status: int, line: str
) -> None:
    jazzy.add_executable("dies", f"#!/bin/sh\nkill -{int(number)} $$\n")
    done = jazzy.ros2("run", "my_robot_controller", "dies")
    assert (done.status, done.stdout) == (status, f"[ros2run]: {line}\n")


@pytest.mark.parametrize(
    ("typed", "received"),
    [
        (["zero", "--", "a"], "['a']"),
        (["zero", "a", "--", "b"], "['a', '--', 'b']"),
        (["zero", "-h"], "['-h']"),
        (["zero", "a", "--help"], "['a', '--help']"),
        (["zero", "--prefix=x", ""], "['--prefix=x', '']"),
        (["--", "zero", "--ros-args"], "['--ros-args']"),
        (["--prefix", "env", "zero", "-1"], "['-1']"),
    ],
)
def test_arguments_are_passed_on_as_typed(
    jazzy: Surroundings, typed: list[str], received: str
) -> None:
    done = jazzy.ros2("run", "my_robot_controller", *typed)
    assert (done.status, done.stdout, done.stderr) == (0, received + "\n", "")


def test_help(jazzy: Surroundings) -> None:
    done = jazzy.ros2("run", "-h")
    assert (done.status, done.stderr) == (0, "")
    assert (
        done.stdout
        == """\
usage: ros2 run [-h] [--prefix PREFIX] package_name executable_name ...

Run a package specific executable

positional arguments:
  package_name     Name of the ROS package
  executable_name  Name of the executable
  argv             Pass arbitrary arguments to the executable

options:
  -h, --help       show this help message and exit
  --prefix PREFIX  Prefix command, which should go before the executable.
                   Command must be wrapped in quotes if it contains spaces
                   (e.g. --prefix 'gdb -ex run --args').
"""
    )


def test_ros2_run_costs_little_more_than_a_start_of_python(jazzy: Surroundings) -> None:
    jazzy.add_executable("true", "#!/bin/true\n")
    jazzy.ros2("run", "my_robot_controller", "true")  # compiles the modules
    run, python = [], []
    for _ in range(5):  # in turn, so that both meet the same load
        ros2 = str(jazzy.prefix / "bin" / "ros2")
        run.append(_processor_seconds(jazzy, ros2, "run", "my_robot_controller", "true"))
        python.append(_processor_seconds(jazzy, sys.executable, "-c", ""))
    assert min(run) < MOST_STARTS * min(python)


def _processor_seconds(jazzy: Surroundings, program: str, *arguments: str) -> float:
    """Return the processor time of a program and of what it runs."""
    process = os.posix_spawn(program, [program, *arguments], jazzy.environment)
    _, status, used = os.wait4(process, 0)
    assert status == 0
    return used.ru_utime + used.ru_stime
