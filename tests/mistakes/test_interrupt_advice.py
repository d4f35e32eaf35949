"""The advice on a traceback after Ctrl+C."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.corpus.broken import BROKEN
from tests.corpus.build import write
from tests.corpus.right import RIGHT
from tests.recorded import mark

BY_NAME = {package.name: package for package in (*BROKEN, *RIGHT)}


@pytest.mark.parametrize(
    ("name", "line"), [("while_in_constructor", 17), ("sleep_loop", 0), ("period_half", 0)]
)
def test_a_traceback_from_outside_of_the_try_is_explained(
    name: str, line: int, tmp_path: Path
) -> None:
    report = mark(write(BY_NAME[name], tmp_path))
    (check,) = (check for check in report.checks if check.id == "run.interrupt")
    assert check.status == "passed"
    assert ([f"comes from line {line}:" in text for text in check.advice] == [True]) == bool(line)


def test_an_except_of_exception_is_named(tmp_path: Path) -> None:
    report = mark(write(BY_NAME["catches_exception"], tmp_path))
    (check,) = (check for check in report.checks if check.id == "run.interrupt")
    assert any("in line 28 does not catch Ctrl+C" in text for text in check.advice)
