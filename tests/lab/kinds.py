"""The kinds of lab; every test with an open lab runs the same steps in each of them."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pytest

WORKER = os.environ.get("PYTEST_XDIST_WORKER", "gw0")
REPOSITORY = os.environ.get("GRADER_IMAGES", "ros2-teaching-lab-tests")
LABEL = "ros2-teaching-lab.lab"


@dataclass(frozen=True)
class Kind:
    """A kind of lab: the value of --sandbox, and the variables that choose its image."""

    sandbox: str
    env: dict[str, str] = field(default_factory=dict)


# A minute each in a container, of what bubblewrap's part shows too: `make test-long` runs that
long_in_a_container = pytest.mark.parametrize(
    "kind",
    [
        "bubblewrap",
        *(
            pytest.param(image, marks=[pytest.mark.docker, pytest.mark.long])
            for image in ("lab-jazzy", "lab-jazzy-wheels")
        ),
    ],
    indirect=True,
)


def open_kind(name: str) -> Iterator[Kind]:
    """Yield a kind: `bubblewrap`, or Docker with only `lab-jazzy` or `lab-jazzy-wheels`."""
    if name == "bubblewrap":
        yield Kind("bubblewrap")
        return
    import docker

    client = docker.from_env()
    repository = f"{REPOSITORY}-test-{WORKER}"
    try:
        if not client.images.get(f"{REPOSITORY}:{name}").tag(repository, name):
            pytest.fail(f"Docker does not tag {name}")
        yield Kind("docker", {"GRADER_IMAGES": repository})
    finally:
        client.images.remove(f"{repository}:{name}")
        client.close()


def containers(workspace: Path) -> list[str]:
    """Return the states of all containers with this workspace, running or not."""
    import docker

    client = docker.from_env()
    try:
        found = client.api.containers(all=True, filters={"label": LABEL})
        return [
            str(each["State"])
            for each in found
            if any(mount.get("Source") == str(workspace) for mount in each["Mounts"])
        ]
    finally:
        client.close()
