"""The verdicts on the whole corpus: right variants get full marks; each broken package fails where,
and why, it must, and only what depends on that is skipped.

The evidence is recorded (tests/recorded.py); tests/test_real_verdicts.py builds and runs.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.corpus.broken import BROKEN
from tests.corpus.build import write
from tests.corpus.model import Package
from tests.corpus.right import RIGHT
from tests.marking import COURSE, assert_full_marks, assert_verdict
from tests.recorded import mark


@pytest.mark.parametrize("package", RIGHT, ids=lambda package: package.name)
def test_a_right_variant_gets_full_marks(package: Package, tmp_path: Path) -> None:
    assert_full_marks(package, mark(write(package, tmp_path)))


@pytest.mark.parametrize("package", BROKEN, ids=lambda package: package.name)
def test_a_broken_package_fails_where_and_why_it_must(package: Package, tmp_path: Path) -> None:
    assert_verdict(package, mark(write(package, tmp_path)))


def test_the_starter_does_not_get_full_marks() -> None:
    report = mark(COURSE / "starter")
    assert report.score < 60
    assert report.status == "graded"


def test_the_tutorials_traceback_is_advice_and_not_a_failure(tmp_path: Path) -> None:
    tutorial = next(package for package in RIGHT if package.name == "tutorial")
    report = mark(write(tutorial, tmp_path))
    assert report.score == 100
    assert "rcl_shutdown already called" in report.evidence.transcript
    assert report.observed.exit is not None
    assert report.observed.exit.status == 1
    assert "try_shutdown" in report.check("run.interrupt").advice[0]
