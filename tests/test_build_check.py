"""The result of `build.colcon` for a failing setup.py, from real colcon output."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.package.edit.tree import Replace
from tests.corpus.broken import BROKEN
from tests.corpus.build import write
from tests.corpus.model import Package
from tests.recorded import mark

BY_NAME = {package.name: package for package in BROKEN}


@pytest.mark.parametrize(
    ("name", "error", "code"),
    [
        ("setup_import_error", "No module named 'setuptool'", "from setuptool import setup"),
        ("setup_raises", "RuntimeError: not today", "raise RuntimeError('not today')"),
    ],
)
def test_the_error_of_setup_py_is_reported_instead_of_colcons(
    name: str, error: str, code: str, tmp_path: Path
) -> None:
    package = write(BY_NAME[name], tmp_path)
    found = next(c for c in mark(package).checks if c.id == "build.colcon")
    assert found.actual.splitlines()[0].endswith(error)
    assert found.where is not None
    lines = (package / "setup.py").read_text(encoding="utf-8").splitlines()
    assert found.where.line == lines.index(code) + 1


def test_a_build_that_gets_no_marker_passes_with_advice(tmp_path: Path) -> None:
    imports = Replace("setup.py", "\nsetup(\n", "\nfrom glob import glob\n\nsetup(\n")
    nothing = Replace("setup.py", "['resource/' + package_name]", "glob('res/*')")
    package = write(Package(name="marker_from_a_glob", edits=(imports, nothing)), tmp_path)
    found = next(c for c in mark(package).checks if c.id == "build.colcon")
    assert found.status == "passed"
    assert "resource/my_robot_controller" in "".join(str(one) for one in found.advice)
