"""An unusable Docker daemon is reported quickly, with a fix."""

from __future__ import annotations

import json
import socket
import threading
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, HTTPServer
from pathlib import Path

import docker.errors
import pytest

from grader.base.errors import SurroundingsError
from grader.ros import images
from grader.sandbox.execs import docker_errors
from tests import processes

pytestmark = [pytest.mark.docker]


class OldDaemon(BaseHTTPRequestHandler):
    """A server that answers like Docker 18.09."""

    def do_GET(self) -> None:
        """Answer `GET /version`."""
        body = json.dumps({"Version": "18.09.9", "ApiVersion": "1.39"}).encode()
        self.send_response(200)
        self.send_header("Content-Type", "application/json")
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, format: str, *args: object) -> None:
        """Log nothing."""


@pytest.fixture
def old_daemon() -> Iterator[str]:
    """The address of a daemon that is too old."""
    server = HTTPServer(("127.0.0.1", 0), OldDaemon)
    thread = threading.Thread(target=server.serve_forever)
    thread.start()
    yield f"tcp://127.0.0.1:{server.server_port}"
    server.shutdown()
    thread.join()
    server.server_close()


def test_a_daemon_that_is_too_old_is_reported(
    old_daemon: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("DOCKER_HOST", old_daemon)
    with pytest.raises(SurroundingsError) as caught:
        images.connect()
    assert "too old (API 1.39" in caught.value.message
    assert "19.03" in caught.value.remedy


def test_a_daemon_that_hangs_is_not_waited_for_long(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(images, "CONNECT_SECONDS", 1.0)
    monkeypatch.setenv("DOCKER_HOST", f"unix://{tmp_path}/docker.sock")
    with socket.socket(socket.AF_UNIX) as deaf:
        deaf.bind(f"{tmp_path}/docker.sock")
        deaf.listen()
        with pytest.raises(SurroundingsError, match="no Docker daemon answers"):
            images.connect()


def test_a_connection_waits_long_enough_for_slow_answers() -> None:
    client = images.connect()
    try:
        assert client.api.timeout == images.REQUEST_SECONDS
    finally:
        client.close()


def test_a_missing_daemon_is_reported_with_a_fix() -> None:
    solution = (
        processes.ROOT / "grader" / "keys" / "hello_time" / "solution" / "my_robot_controller"
    )
    command = processes.grader("grade", solution, "--sandbox", "docker")
    done = processes.run(command, env={"DOCKER_HOST": "unix:///nonexistent/docker.sock"})
    assert done.returncode == 3
    assert "no Docker daemon answers at unix:///nonexistent/docker.sock" in done.stderr
    assert "SANDBOX=bubblewrap" in done.stderr
    assert "Traceback" not in done.stderr


def test_a_socket_without_permission_is_reported_with_a_fix() -> None:
    command = processes.as_user(processes.grader("images"))
    done = processes.run(command, cwd=Path("/"))
    assert done.returncode == 3, done.stdout + done.stderr
    assert "no permission to use the Docker daemon" in done.stderr
    assert "docker" in done.stderr
    assert "Traceback" not in done.stderr


def test_a_full_disk_is_reported_with_a_fix() -> None:
    output = "write /var/lib/docker/tmp/x: no space left on device"
    with (
        pytest.raises(SurroundingsError) as caught,
        docker_errors("opening the sandbox"),
    ):
        raise docker.errors.APIError("500 Server Error", explanation=output)
    assert "no space left" in caught.value.message
    assert "docker system df" in caught.value.remedy
