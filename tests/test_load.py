"""A verdict does not depend on the load of the machine."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.corpus.build import write
from tests.corpus.right import RIGHT
from tests.marking import mark, outcomes, summary

pytestmark = pytest.mark.alone
TIMES = 30


@pytest.fixture
def busy_cores() -> Iterator[None]:
    """Keep every core busy with other work during the test."""
    work = [
        subprocess.Popen([sys.executable, "-c", "while True: pass"])
        for _ in range(os.cpu_count() or 1)
    ]
    yield
    for process in work:
        process.kill()
        process.wait()


@pytest.mark.long
@pytest.mark.usefixtures("busy_cores")
def test_thirty_verdicts_on_a_busy_machine_are_equal(tmp_path: Path) -> None:
    tutorial = next(package for package in RIGHT if package.name == "tutorial")
    root = write(tutorial, tmp_path)
    reports = [mark(root) for _ in range(TIMES)]
    for report in reports:
        assert report.score == 100, summary(report)
        assert report.observed.clock == "virtual"
    assert all(outcomes(report) == outcomes(reports[0]) for report in reports)


@pytest.mark.usefixtures("busy_cores")
@pytest.mark.full
def test_a_busy_machine_changes_no_verdict(tmp_path: Path) -> None:
    root = write(RIGHT[0], tmp_path)
    assert [mark(root).score for _ in range(3)] == [100, 100, 100]
