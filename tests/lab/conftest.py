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

# whose part in a container `make test-long` runs: a minute each, of what bubblewrap's shows too
LONG_IN_A_CONTAINER = (
    "test_guide_and_check_belong_to_the_lesson_of_the_lab",
    "test_the_guide_leads_to_full_marks",
    "test_the_ten_steps_work_literally_and_a_second_lab_keeps_them",
)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if item.name.startswith(LONG_IN_A_CONTAINER) and item.get_closest_marker("docker"):
            item.add_marker(pytest.mark.long)


@pytest.fixture(params=["bubblewrap", *IMAGES])
def kind(request: pytest.FixtureRequest, ros_jazzy: Ros) -> Iterator[Kind]:
    """Each kind of lab."""
    yield from open_kind(request.param)


@pytest.fixture(params=IMAGES)
def docker_kind(request: pytest.FixtureRequest) -> Iterator[Kind]:
    """Each kind of lab in a container."""
    yield from open_kind(request.param)
