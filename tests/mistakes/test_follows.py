"""A failure that another one causes names it, and has no fix of its own."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.corpus.broken import BROKEN
from tests.corpus.build import write
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
    ],
)
def test_the_check_with_the_cause_is_named(
    name: str, check: str, cause: str, tmp_path: Path
) -> None:
    result = mark(write(BY_NAME[name], tmp_path)).check(check)
    assert result.consequence_of == cause
    assert result.fix == f"This follows from {cause}. Fix {cause} first."
    assert result.patch == ""


def test_two_mistakes_of_their_own_have_two_fixes(tmp_path: Path) -> None:
    for check in mark(write(BY_NAME["as_created"], tmp_path)).checks:
        assert check.consequence_of == ""


def test_the_missing_function_is_told_once(tmp_path: Path) -> None:
    report = mark(write(BY_NAME["main_under_guard"], tmp_path))
    assert report.check("entry_point.mapping").advice == []
    assert report.check("run.starts").where is not None
    report = mark(write(BY_NAME["node_empty"], tmp_path))
    assert report.check("entry_point.mapping").advice == []
