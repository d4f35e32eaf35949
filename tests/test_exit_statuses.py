"""Exit statuses of the student's code count for the student, even 126 and 127."""

from __future__ import annotations

from pathlib import Path
from textwrap import indent

import pytest

from grader.package.edit.tree import Replace, Write
from tests.corpus.build import write
from tests.corpus.model import NODE, SETUP, Package
from tests.marking import mark, summary

IMPORT = "from setuptools import setup\n"
INSTALLING = """
import os
import sys
if 'develop' in sys.argv and '--help' not in sys.argv:
{code}
    os._exit({status})  # colcon ends with this status then
"""
# makes the programs of ROS fail for the grader as well, if they read files that this code wrote
SPOIL = """
home = os.path.expanduser('~')
python = f'python{sys.version_info[0]}.{sys.version_info[1]}'
site = os.path.join(home, '.local', 'lib', python, 'site-packages')
os.makedirs(site, exist_ok=True)
for place in (home, home + '/ros2_ws', '/tmp', site, '/opt/ros/jazzy/bin', '/dev/shm'):
    for name in ('rclpy', 'colcon_core', 'usercustomize', 'sitecustomize'):
        try:
            with open(os.path.join(place, name + '.py'), 'w') as spoilt:
                spoilt.write('import os; os._exit(127)')
        except OSError:
            pass
for name in ('.bashrc', '.profile', '.bash_profile'):
    with open(os.path.join(home, name), 'w') as spoilt:
        spoilt.write('exit 127')
"""
UNREADY = "#!/usr/bin/env python3\nimport os\n\n\ndef main():\n    os._exit({status})\n"


def installing(status: int, code: str = "") -> Replace:
    """Return the edit that makes setup.py run this code and exit when colcon installs it."""
    return Replace(
        SETUP, IMPORT, IMPORT + INSTALLING.format(code=indent(code, "    "), status=status)
    )


def later(*statuses: int) -> list[object]:
    """Return the parameters that wait for the long run."""
    return [pytest.param(status, marks=pytest.mark.long) for status in statuses]


def package(*edits: Replace | Write) -> Package:
    return Package(name="solution", edits=edits)


@pytest.mark.prefix
@pytest.mark.parametrize(
    "status", [pytest.param(127, marks=pytest.mark.full), *later(126, 250, 251)]
)
def test_a_status_of_setup_py_is_the_students(status: int, tmp_path: Path) -> None:
    report = mark(write(package(installing(status)), tmp_path))
    found = next(check for check in report.checks if check.id == "build.colcon")
    assert found.status == "failed", summary(report)
    assert f"exited with code {status}" in found.actual


@pytest.mark.full
@pytest.mark.prefix
def test_a_setup_py_that_writes_files_everywhere_gains_nothing(tmp_path: Path) -> None:
    report = mark(write(package(installing(127, SPOIL)), tmp_path))
    found = next(check for check in report.checks if check.id == "build.colcon")
    assert found.status == "failed", summary(report)
    assert "exited with code 127" in found.actual


@pytest.mark.prefix
@pytest.mark.parametrize("status", later(126, 127))
def test_a_status_of_the_node_is_the_students(status: int, tmp_path: Path) -> None:
    report = mark(write(package(Write(NODE, UNREADY.format(status=status), 0o755)), tmp_path))
    found = next(check for check in report.checks if check.id == "run.starts")
    assert found.status == "failed", summary(report)
    assert "run.exits_at_once" in [mistake.id for mistake in found.mistakes]
    assert f"with status {status}" in found.actual
