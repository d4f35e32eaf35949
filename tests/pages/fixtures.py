"""Fixtures shared by the tests of the pages and of the feedback: one browser, real reports.

tests/conftest.py loads this as a plugin: a session fixture imported into two conftest.py files
would be two fixtures, and a process would start two browsers, which Playwright refuses.
"""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser

from grader.report.model import Report
from tests.pages import browser, classes


@pytest.fixture(scope="session")
def reports(tmp_path_factory: pytest.TempPathFactory) -> tuple[Report, ...]:
    """Reports of a solution and of packages with mistakes."""
    folder = tmp_path_factory.mktemp("packages")
    return tuple(classes.marked(name, folder) for name in classes.REAL)


@pytest.fixture(scope="session")
def chromium() -> Iterator[Browser]:
    with browser.browser() as started:
        yield started


@pytest.fixture
def visit(chromium: Browser) -> Iterator[browser.Open]:
    """A function that opens a page in a separate context and records what it does."""
    with browser.opening(chromium) as new:
        yield new
