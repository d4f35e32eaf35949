"""Fixtures that the tests of the page and of the feedback share: one browser, real reports.

A plugin of tests/conftest.py: a session's fixture that is imported into two conftest.py is two
fixtures, and a process in which tests of both run would start two browsers, which Playwright refuses.
"""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser

from grader.report.model import Report
from tests.site import browser, classes


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
    """Opens pages, each in a context of its own, and witnesses what they do."""
    with browser.opening(chromium) as new:
        yield new
