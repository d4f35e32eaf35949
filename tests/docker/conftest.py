"""Fixtures of the tests that need the Docker daemon."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest
from docker import DockerClient

from grader.ros import images
from grader.ros.distro import find_distro
from grader.sandbox.base import Sandbox
from grader.sandbox.docker_sandbox import DockerSandbox
from grader.sandbox.limits import Limits
from tests import engine


@pytest.fixture(autouse=True)
def own_images(monkeypatch: pytest.MonkeyPatch) -> None:
    """Use the tests' own images only."""
    monkeypatch.setenv(images.REPOSITORY_VARIABLE, engine.REPOSITORY)


@pytest.fixture
def client() -> Iterator[DockerClient]:
    """A connection to the daemon."""
    opened = images.connect()
    yield opened
    opened.close()


def docker_sandbox(limits: Limits) -> Sandbox:
    """Return a `docker` sandbox on jazzy with given limits."""
    jazzy = find_distro("jazzy")
    opened = images.connect()
    image = images.find_image(opened, jazzy)
    if image is None:
        pytest.fail("the tests' images are not here: python -m tests.engine up")
    return DockerSandbox(opened, image, jazzy, limits)


@pytest.fixture
def make_sandbox() -> Callable[[Limits], Sandbox]:
    """A function that makes a `docker` sandbox on jazzy with given limits."""
    return docker_sandbox


@pytest.fixture(scope="module")
def sandbox() -> Iterator[Sandbox]:
    """One `docker` sandbox for the tests of a module: its commands end with each test."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setenv(images.REPOSITORY_VARIABLE, engine.REPOSITORY)
        with docker_sandbox(Limits()) as opened:
            yield opened
