"""Fixtures of the lab's tests."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from grader.base.unheard import unheard
from grader.ros.interfaces import with_turtlesim
from grader.ros.prefix import Ros
from tests.lab.kinds import Kind, open_kind

IMAGES = (
    pytest.param("lab-jazzy", marks=pytest.mark.docker),
    pytest.param("lab-jazzy-wheels", marks=[pytest.mark.docker, pytest.mark.long]),
)


@pytest.fixture(scope="session")
def ros_jazzy(ros_jazzy: Ros) -> Ros:
    """ROS as a lab has it: what takes a minute once is made before a terminal is waited for."""
    return with_turtlesim(ros_jazzy, notify=unheard)


@pytest.fixture(scope="session")
def ros_kilted(ros_kilted: Ros) -> Ros:
    return with_turtlesim(ros_kilted, notify=unheard)


@pytest.fixture(params=["bubblewrap", *IMAGES])
def kind(request: pytest.FixtureRequest, ros_jazzy: Ros) -> Iterator[Kind]:
    """Each kind of lab."""
    yield from open_kind(request.param)


@pytest.fixture(params=IMAGES)
def docker_kind(request: pytest.FixtureRequest) -> Iterator[Kind]:
    """Each kind of lab in a container."""
    yield from open_kind(request.param)
