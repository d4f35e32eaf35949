"""Fixtures: classes and reports, made from the real reports of a test session."""

from __future__ import annotations

import pytest

from grader.batch.model import ClassResult
from grader.report.model import Report
from tests.pages import classes


@pytest.fixture
def mixed(reports: tuple[Report, ...]) -> ClassResult:
    """A class of 24 with every kind of student: late, missing, ungradable, corrected, …"""
    return classes.mixed(reports, 24)


@pytest.fixture
def broken(reports: tuple[Report, ...]) -> Report:
    """The real report of a package whose node says `hello time`."""
    return reports[classes.REAL.index("text_capital")]


@pytest.fixture
def solution(reports: tuple[Report, ...]) -> Report:
    return reports[classes.REAL.index("solution")]
