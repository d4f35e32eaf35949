"""What the report says of values in setup.py, setup.cfg and package.xml: their line and the change."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.package.source.setup_packages import packages_of
from grader.report.model import CheckResult
from tests.corpus.broken import BROKEN
from tests.corpus.build import write
from tests.recorded import mark

BY_NAME = {package.name: package for package in BROKEN}
PACKAGE = "my_robot_controller"


def _check(name: str, check: str, tmp_path: Path) -> tuple[CheckResult, str]:
    """Return a check of a broken package, and the source line that it names."""
    package = write(BY_NAME[name], tmp_path)
    found = mark(package).check(check)
    where = found.where
    assert where is not None
    rows = (package / where.file).read_text(encoding="utf-8").splitlines()
    return found, rows[where.line - 1] if where.line else ""


@pytest.mark.parametrize(
    ("name", "check", "code", "said"),
    [
        ("setup_cfg_variable_of_setup_py", "package.setup_cfg", "$package_name", "these four lines"),
        ("setup_cfg_first_heading_missing", "package.setup_cfg", "script_dir", "[develop], below it"),
        ("entry_points_lost", "entry_point.mapping", "setup(", "Write in setup()"),
        ("entry_made_with_the_ending", "entry_point.mapping", "'console_scripts'", "the code that makes"),
        ("setup_argument_repeated", "build.colcon", "", "Give entry_points to setup() only once"),
        ("entry_in_setup_cfg", "build.colcon", "'test_node =", "below [install] in setup.cfg"),
    ],
)  # fmt: skip
def test_the_line_and_the_change_are_named(
    name: str, check: str, code: str, said: str, tmp_path: Path
) -> None:
    found, row = _check(name, check, tmp_path)
    assert code in row
    assert said in found.fix


def test_a_path_of_setup_cfg_that_stops_the_build_costs_points_once(tmp_path: Path) -> None:
    report = mark(write(BY_NAME["setup_cfg_variable_of_setup_py"], tmp_path))
    assert report.check("build.colcon").status == "skipped"


def test_a_folder_of_another_name_is_told_once(tmp_path: Path) -> None:
    package = write(BY_NAME["setup_raises"], tmp_path)
    setup = package / "setup.py"
    code = setup.read_text(encoding="utf-8").replace("raise RuntimeError('not today')\n", "")
    code = code.replace("find_packages(exclude=['test'])", "[package_name]")
    setup.write_text(code, encoding="utf-8")
    (package / PACKAGE).rename(package / "robot_code")
    report = mark(package)
    assert report.check("source.node_file").status == "failed"
    assert report.check("build.colcon").status == "skipped"


@pytest.mark.parametrize(
    ("code", "there"),
    [
        ("packages=['my_robot_controller']", True),
        ("packages=NAMES", True),
        ("packages=['robot']", False),
        ("packages=find_packages('src')", False),
    ],
)
def test_what_is_in_packages_is_known(code: str, there: bool) -> None:
    rows = ("from setuptools import setup, find_packages", f"NAMES = ['{PACKAGE}']")
    found = "\n".join((*rows, f"setup({code})", "")).encode()
    assert packages_of(found, PACKAGE, nested=False).is_there == there
