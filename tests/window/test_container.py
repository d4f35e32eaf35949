"""The window of a lab in a container: the host's browser reaches it, another container does not."""

from __future__ import annotations

import urllib.error
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import docker
import pytest
from docker.models.containers import Container

from tests.lab.kinds import LABEL, REPOSITORY, Kind, open_kind
from tests.lab.screen import Lab
from tests.window.programs import ADDRESS

pytestmark = pytest.mark.docker

# asks for the page with the right Host and token, and prints the first bytes of the answer
ASK = """
import socket, sys
host, port, path = sys.argv[1], int(sys.argv[2]), sys.argv[3]
with socket.create_connection((host, port), 10) as peer:
    try:
        peer.sendall(f"GET {path} HTTP/1.1\\r\\nHost: 127.0.0.1:{port}\\r\\n\\r\\n".encode())
        print(peer.recv(12))
    except ConnectionError:
        print(b"")
"""


@pytest.fixture
def image() -> Iterator[Kind]:
    yield from open_kind("lab-jazzy")


def of_workspace(client: docker.DockerClient, workspace: Path) -> Container:
    """Return the container of the lab with this workspace."""
    labs = client.containers.list(filters={"label": LABEL})
    found = [
        each
        for each in labs
        if any(mount.get("Source") == str(workspace) for mount in each.attrs["Mounts"])
    ]
    assert len(found) == 1
    return found[0]


def test_only_the_host_gets_an_answer_and_only_with_the_token(image: Kind, tmp_path: Path) -> None:
    workspace = tmp_path / "ros2_ws"
    client = docker.from_env()
    with Lab(image, workspace) as lab:
        lab.screen.sendline("lab window")
        lab.screen.expect(ADDRESS.pattern)
        address, port = lab.screen.match[0], lab.screen.match[1]
        with urllib.request.urlopen(address, timeout=30) as answer:
            assert answer.status == 200
        with pytest.raises(urllib.error.HTTPError, match="403"):
            urllib.request.urlopen(f"http://127.0.0.1:{port}/", timeout=30)
        container = of_workspace(client, workspace)
        networks = container.attrs["NetworkSettings"]["Networks"]
        (network,) = networks
        inside = networks[network]["IPAddress"]
        path = address.removeprefix(f"http://127.0.0.1:{port}")
        ask = ["python3", "-c", ASK]
        own = container.exec_run([*ask, "127.0.0.1", port, path])
        assert own.output == b"b'HTTP/1.1 200'\n"
        other = client.containers.run(
            f"{REPOSITORY}:lab-jazzy",
            [*ask, inside, port, path],
            entrypoint="",
            network=network,
            remove=True,
        )
        assert other == b"b''\n"
        lab.interrupt()
        assert lab.leave() == 0
    client.close()
