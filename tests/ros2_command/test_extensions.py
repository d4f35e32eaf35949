"""`ros2 lab` and `ros2 grade`: on the wheels, and as extensions of ros2cli (replaced by its contract).

ros2cli finds a command by the entry point group `ros2cli.command`, makes an object of its class,
gives `add_arguments` the parser of the command, and calls `main` with the parser and the arguments.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests import processes

FOLDER = processes.ROOT / "lab/shell/ros2cli"
CONTRACT = """\
import sys
from argparse import ArgumentParser
from importlib.metadata import entry_points

parser = ArgumentParser(prog="ros2")
commands = parser.add_subparsers()
for point in entry_points(group="ros2cli.command"):
    extension = point.load()()
    command = commands.add_parser(point.name, help=extension.__doc__)
    extension.add_arguments(command, "ros2 " + point.name)
    command.set_defaults(main=extension.main, parser=command)
args = parser.parse_args()
sys.exit(args.main(parser=args.parser, args=args))
"""
PROGRAM = '#!/bin/sh\necho "$(basename "$0"):" "$@"\nexit 7\n'


@pytest.fixture
def env(tmp_path: Path) -> dict[str, str]:
    """A terminal of the lab in which `lab` and `check` print their arguments."""
    programs = tmp_path / "bin"
    programs.mkdir()
    for name in ("lab", "check"):
        (programs / name).write_text(PROGRAM, encoding="ascii")
        (programs / name).chmod(0o755)
    return {"LAB_PROGRAMS": str(programs)}


@pytest.fixture
def ros2cli(tmp_path: Path) -> Path:
    """What the extensions import of ros2cli."""
    folder = tmp_path / "ros2cli_contract"
    (folder / "ros2cli").mkdir(parents=True)
    (folder / "ros2cli/command.py").write_text("class CommandExtension: ...\n", encoding="ascii")
    (folder / "ros2cli/__init__.py").touch()
    return folder


WORDS = [
    (("grade", "--hints", "2"), "check: --hints 2\n"),
    (("grade", "-h"), "check: -h\n"),
    (("lab", "hint"), "lab: hint\n"),
    (("lab",), "lab:\n"),
]


@pytest.mark.parametrize(("words", "called"), WORDS)
def test_ros2cli_finds_them(
    words: tuple[str, ...], called: str, env: dict[str, str], ros2cli: Path
) -> None:
    path = {"PYTHONPATH": f"{ros2cli}:{FOLDER}"}
    done = processes.run([sys.executable, "-c", CONTRACT, *words], env=env | path)
    assert (done.returncode, done.stdout, done.stderr) == (7, called, "")


def test_outside_of_a_lab_grade_marks_and_lab_says_where(ros2cli: Path) -> None:
    env = {"PYTHONPATH": f"{ros2cli}:{FOLDER}:{processes.ROOT}", "LAB_PROGRAMS": ""}
    call = [sys.executable, "-c", CONTRACT]
    done = processes.run([*call, "grade", "--help"], env=env)
    assert done.returncode == 0
    assert done.stdout.startswith("Usage: grader grade ")
    done = processes.run([*call, "lab"], env=env)
    assert (done.returncode, done.stdout) == (1, "")
    assert "make lab" in done.stderr


def test_the_projects_own_installation_has_the_same_commands() -> None:
    setup = (processes.ROOT / "setup.py").read_text(encoding="utf-8")
    points = (FOLDER / "ros2_teaching_lab_command-1.dist-info/entry_points.txt").read_text()
    for line in points.splitlines()[1:]:
        assert line.replace("ros2_teaching_lab_command.", "grader.") in setup


@pytest.mark.prefix
@pytest.mark.parametrize(("words", "called"), WORDS)
def test_the_wheels_have_them(
    words: tuple[str, ...], called: str, env: dict[str, str], jazzy_prefix: Path
) -> None:
    line = ["bash", "-c", 'source "$0" && exec ros2 "$@"', str(jazzy_prefix / "setup.bash"), *words]
    done = subprocess.run(
        line, env={**os.environ, **env}, capture_output=True, text=True, timeout=60, check=False
    )
    assert (done.returncode, done.stdout, done.stderr) == (7, called, "")
