"""Fixtures of the lab's tests."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from grader.ros.prefix import Ros
from tests.lab.kinds import Kind, open_kind

IMAGES = (
    pytest.param("lab-jazzy", marks=pytest.mark.docker),
    pytest.param("lab-jazzy-wheels", marks=[pytest.mark.docker, pytest.mark.long]),
)


@pytest.fixture(params=["bubblewrap", *IMAGES])
def kind(request: pytest.FixtureRequest, ros_jazzy: Ros) -> Iterator[Kind]:
    """Each kind of lab."""
    yield from open_kind(request.param)


@pytest.fixture(params=IMAGES)
def docker_kind(request: pytest.FixtureRequest) -> Iterator[Kind]:
    """Each kind of lab in a container."""
    yield from open_kind(request.param)
