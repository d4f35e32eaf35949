"""Fixtures shared by the tests of the pages and of the feedback: one browser, real reports.

tests/conftest.py loads this as a plugin: a session fixture imported into two conftest.py files
would be two fixtures, and a process would start two browsers, which Playwright refuses.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser

from grader.base.cache import make_once
from grader.report.files import report_json
from grader.report.model import Report
from grader.ros.prefix import Ros
from tests.pages import browser, classes


@pytest.fixture(scope="session")
def reports(ros_jazzy: Ros, tmp_path_factory: pytest.TempPathFactory) -> tuple[Report, ...]:
    """Reports of the solution and of broken packages, marked once for all test processes."""
    base = tmp_path_factory.getbasetemp()
    shared = base.parent if "PYTEST_XDIST_WORKER" in os.environ else base

    def make(staging: Path) -> None:
        for name in classes.REAL:
            report = classes.marked(name, staging)
            (staging / f"{name}.json").write_text(report_json(report), encoding="utf-8")

    folder = shared / "site-reports"
    make_once(folder, make, say=lambda text: None)
    found = [(folder / f"{name}.json").read_text(encoding="utf-8") for name in classes.REAL]
    return tuple(Report.model_validate_json(text) for text in found)


@pytest.fixture(scope="session")
def chromium() -> Iterator[Browser]:
    with browser.browser() as started:
        yield started


@pytest.fixture
def visit(chromium: Browser) -> Iterator[browser.Open]:
    """A function that opens a page in a separate context and records what it does."""
    with browser.opening(chromium) as new:
        yield new
