"""The error in what colcon prints when CMake ends a build (texts of CMake 3.28)."""

from __future__ import annotations

import pytest

from grader.verdict.checks.cmake import CMakeError, cmake_error

BEFORE = "Starting >>> my_robot_interfaces\n--- stderr: my_robot_interfaces\n"
AFTER = "\n\n\n---\nFailed   <<< my_robot_interfaces [0.4s, exited with code 1]\n"
INSIDE = """\
CMake Error at /opt/ros/jazzy/share/rosidl_cmake/cmake/rosidl_generate_interfaces.cmake:64 (message):
  rosidl_generate_interfaces() must be called before ament_package()
Call Stack (most recent call first):
  CMakeLists.txt:9 (rosidl_generate_interfaces)"""
SYNTAX = """\
CMake Error at CMakeLists.txt:7:
  Parse error.  Function missing ending ")".  End of file reached."""
UNKNOWN = """\
CMake Error at CMakeLists.txt:5 (find_packages):
  Unknown CMake command "find_packages"."""


@pytest.mark.parametrize(
    ("log", "line", "text"),
    [
        (INSIDE, 9, "rosidl_generate_interfaces() must be called before ament_package()"),
        (SYNTAX, 7, 'Parse error. Function missing ending ")". End of file reached.'),
        (UNKNOWN, 5, 'Unknown CMake command "find_packages".'),
        (f"{UNKNOWN}\n\n\n{SYNTAX}", 5, 'Unknown CMake command "find_packages".'),  # the first one
    ],
)
def test_the_line_is_that_of_the_package(log: str, line: int, text: str) -> None:
    assert cmake_error(BEFORE + log + AFTER) == CMakeError("my_robot_interfaces", line, text)


@pytest.mark.parametrize(
    "log",
    [
        "",
        UNKNOWN,  # of which package?
        f"{BEFORE}CMake Error at /opt/ros/jazzy/share/a/cmake/a.cmake:3 (message):\n  no{AFTER}",
        f"{BEFORE}CMake Error: The source directory does not exist.{AFTER}",
        f"{BEFORE}ninja: build stopped: subcommand failed.{AFTER}",
    ],
)
def test_otherwise_there_is_none(log: str) -> None:
    assert cmake_error(log) is None
