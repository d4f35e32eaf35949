"""Fixtures of the window's tests."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from grader.ros.interfaces import with_interfaces
from grader.ros.prefix import Ros
from tests.window import programs


@pytest.fixture(scope="module")
def ros_env(ros_jazzy: Ros, tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """The environment of a terminal with ROS and turtlesim's interfaces, in its own domain.

    A program that was killed in another module's domain cannot disturb this one's: what it leaves
    in shared memory belongs to its domain's ports.
    """
    ros = with_interfaces(ros_jazzy, notify=lambda text: None)
    return programs.ros_environment(ros.path, tmp_path_factory.mktemp("home"))


@pytest.fixture(scope="module")
def talk(ros_env: dict[str, str]) -> Iterator[programs.Talk]:
    with programs.bridge(ros_env) as opened:
        yield opened


@pytest.fixture(scope="module")
def opened(ros_env: dict[str, str]) -> Iterator[programs.OpenWindow]:
    with programs.window(ros_env) as running:
        yield running
