"""A failure that another one causes names it, and has no fix of its own."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from grader.verdict.static import evaluate_static
from grader.verdict.take_in import take_in_for
from tests.corpus.broken import BROKEN
from tests.corpus.build import write
from tests.marking import ASSIGNMENT
from tests.recorded import mark

BY_NAME = {package.name: package for package in BROKEN}


@pytest.mark.parametrize(
    ("name", "check", "cause"),
    [
        ("created_inside_itself", "entry_point.mapping", "source.node_file"),
        ("cmake_package_with_node", "package.marker", "package.manifest"),
        ("cmake_package_with_node", "package.setup_cfg", "package.manifest"),
        ("cmake_package", "entry_point.mapping", "package.manifest"),
        ("node_empty", "source.shebang", "source.node_file"),
        ("setup_cfg_key_misspelt", "build.colcon", "package.setup_cfg"),
    ],
)
def test_the_check_with_the_cause_is_named(
    name: str, check: str, cause: str, tmp_path: Path
) -> None:
    result = mark(write(BY_NAME[name], tmp_path)).check(check)
    assert result.consequence_of == cause
    assert result.fix == f"This follows from {cause}. Fix {cause} first."
    assert result.patch == ""
    assert result.rationale == ""  # (that of the cause says it)


def test_the_build_that_a_key_of_setup_cfg_stops_has_its_line(tmp_path: Path) -> None:
    report = mark(write(BY_NAME["setup_cfg_key_misspelt"], tmp_path))
    (cause, build) = (report.check(c) for c in ("package.setup_cfg", "build.colcon"))
    assert "install_scripts=$base/lib/my_robot_controller" in cause.fix
    assert cause.where == build.where
    lines = (tmp_path / "setup_cfg_key_misspelt" / "setup.cfg").read_text().splitlines()
    assert cause.where is not None
    assert lines[(cause.where.line or 0) - 1].startswith("install_script=")


def test_two_mistakes_of_their_own_have_two_fixes(tmp_path: Path) -> None:
    for check in mark(write(BY_NAME["as_created"], tmp_path)).checks:
        assert check.consequence_of == ""


def test_the_missing_function_is_told_once(tmp_path: Path) -> None:
    report = mark(write(BY_NAME["main_under_guard"], tmp_path))
    assert report.check("entry_point.mapping").advice == []
    assert report.check("run.starts").where is not None
    report = mark(write(BY_NAME["node_empty"], tmp_path))
    assert report.check("entry_point.mapping").advice == []


@pytest.mark.parametrize("name", ["init_missing", "cmake_package_with_node"])
def test_the_missing_init_file_is_told_once(name: str, tmp_path: Path) -> None:
    package = write(BY_NAME[name], tmp_path)
    (package / ASSIGNMENT.folder / "__init__.py").unlink(missing_ok=True)
    report = mark(package)
    advice = [text for check in report.checks for text in check.advice]
    assert [text for text in advice if "__init__.py" in text] == []


def test_an_ignored_package_is_told_once(tmp_path: Path) -> None:
    report = mark(write(BY_NAME["colcon_ignore"], tmp_path))
    assert "rm COLCON_IGNORE" in report.check("build.colcon").fix
    assert report.check("package.found").advice == []


def test_a_document_has_no_first_line_to_correct(tmp_path: Path) -> None:
    report = mark(write(BY_NAME["word_document"], tmp_path))
    assert "a document of another program" in report.check("source.node_file").fix
    assert report.check("source.shebang").blocked_by == "source.node_file"


@pytest.mark.parametrize("shallow", [False, True], ids=["in the inner folder", "in the package"])
@pytest.mark.parametrize("helper", [False, True], ids=["", "with a helper"])
def test_the_commands_for_a_package_created_inside_lose_nothing(
    shallow: bool, helper: bool, tmp_path: Path
) -> None:
    package = write(BY_NAME["created_inside_itself"], tmp_path)
    folder = package / ASSIGNMENT.folder
    inner = folder / ASSIGNMENT.folder
    if shallow:  # ros2 pkg create was run in the package: the inner one is the folder of the code
        inner.rename(tmp_path / "inner")
        shutil.copytree(tmp_path / "inner", folder, dirs_exist_ok=True)
        inner = folder
    code = inner / ASSIGNMENT.folder
    if helper:
        (code / "helper.py").write_text("NAME = 'x'\n")
    results = evaluate_static(take_in_for(ASSIGNMENT, package), ASSIGNMENT)
    told = next(result for result in results if result.id == "source.node_file")
    assert told.mistakes[0].id == "package.created_inside"
    commands = re.findall(r"(?:mv|rm -r) [^;]+", told.fix)
    assert [command.split()[0] for command in commands] == ["mv", "rm"]
    for command in commands:
        subprocess.run(["bash", "-ec", command], cwd=package, check=True)
    assert (folder / ASSIGNMENT.node_file).is_file()
    assert (folder / "__init__.py").is_file()
    assert [path.parent for path in package.rglob("package.xml")] == [package]
    assert (code / "helper.py").is_file() == helper
