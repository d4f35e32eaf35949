"""Fixtures of the pages' tests (the browser and the reports are in fixtures.py)."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.publish.pages import write_site
from grader.report.model import Report
from tests.pages import axe, classes


@pytest.fixture(scope="session")
def axe_source() -> str:
    return axe.axe_source()


@pytest.fixture(scope="session")
def site(reports: tuple[Report, ...], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The pages of a class of 40 with every kind of student."""
    out = tmp_path_factory.mktemp("site")
    write_site(classes.mixed(reports, 40), out)
    return out
