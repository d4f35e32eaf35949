"""Fixtures of the lab's tests."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from grader.ros.prefix import Ros
from tests.lab.kinds import Kind, open_kind

IMAGES = ("lab-jazzy", "lab-jazzy-wheels")


@pytest.fixture(
    params=["bubblewrap", *(pytest.param(name, marks=pytest.mark.docker) for name in IMAGES)]
)
def kind(request: pytest.FixtureRequest, ros_jazzy: Ros) -> Iterator[Kind]:
    """Each kind of lab."""
    yield from open_kind(request.param)


@pytest.fixture(params=[pytest.param(name, marks=pytest.mark.docker) for name in IMAGES])
def docker_kind(request: pytest.FixtureRequest) -> Iterator[Kind]:
    """Each kind of lab in a container."""
    yield from open_kind(request.param)
