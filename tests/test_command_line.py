"""A program that reads its command line itself is marked as a person starts it."""

from __future__ import annotations

import pytest

from grader.package.intake.model import SourceFile
from grader.package.source.command_line import reads_command_line
from grader.run.run import Run

NODE = "my_robot_controller/my_first_node.py"


@pytest.mark.parametrize(
    ("text", "reads"),
    [
        ("options = parser.parse_args()", True),
        ("options, _ = parser.parse_known_args()", True),
        ("start = int(sys.argv[1])", True),
        ("from sys import argv\nprint(argv)", True),
        ("import click", True),
        ("from typer import Typer", True),
        ("rclpy.init(args=sys.argv)", False),
        ("main(sys.argv)", False),
        ("def main(args=None):\n    rclpy.init(args=args)", False),
        ("# sys.argv", False),
        ("print(", False),
    ],
)
def test_what_reads_the_command_line(text: str, reads: bool) -> None:
    assert reads_command_line([SourceFile(NODE, "file", data=text.encode())]) == reads


def test_setup_py_does_not_count() -> None:
    assert not reads_command_line([SourceFile("setup.py", "file", data=b"print(sys.argv)")])


@pytest.mark.parametrize(
    ("command", "plain"),
    [
        ("ros2 run my_robot_controller test_node", True),
        ("ros2 run my_robot_controller test_node --ros-args -p use_sim_time:=true", False),
        ("", False),
    ],
)
def test_which_run_had_no_arguments(command: str, plain: bool) -> None:
    assert Run(command).plain == plain
