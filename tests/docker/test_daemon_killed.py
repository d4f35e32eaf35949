"""A Docker daemon killed in the middle of a verdict: a clear message, and nothing is left."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from docker import DockerClient

from grader.base.errors import SurroundingsError
from grader.ros import images
from grader.sandbox import orphans
from tests import engine, processes

pytestmark = [pytest.mark.docker, pytest.mark.long]
NAME = f"{engine.REPOSITORY}:grade-jazzy-wheels"
SOLUTION = processes.ROOT / "grader" / "keys" / "hello_time" / "solution" / "my_robot_controller"
START_SECONDS = 60.0


class Daemon:
    """A separate daemon for the test, beside the one that the other tests use."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.address = f"unix://{folder}/docker.sock"
        self._process: subprocess.Popen[bytes] | None = None

    def start(self) -> None:
        folder = self.folder
        # in a separate network namespace: two daemons in one would conflict over their bridge
        command = ["unshare", "--net", "dockerd", "-H", self.address]
        command += ["--data-root", f"{folder}/data", "--exec-root", f"{folder}/exec"]
        command += ["--pidfile", f"{folder}/pid", "--iptables=false", "--ip6tables=false"]
        # (without an init that reaps zombies, a killed daemon's containerd looks alive by its pid)
        for pid in (folder / "pid", folder / "exec" / "containerd" / "containerd.pid"):
            pid.unlink(missing_ok=True)
        with (folder / "log").open("ab") as log:
            self._process = subprocess.Popen(
                command, stdout=log, stderr=log, start_new_session=True
            )
        deadline = time.monotonic() + START_SECONDS
        while True:
            try:
                self.client().close()
            except SurroundingsError:
                if self._process.poll() is not None or time.monotonic() > deadline:
                    pytest.fail((folder / "log").read_text()[-3000:])
                time.sleep(0.1)  # wait until its socket answers
            else:
                return

    def client(self) -> DockerClient:
        before = os.environ.get("DOCKER_HOST")
        os.environ["DOCKER_HOST"] = self.address
        try:
            return images.connect()
        finally:
            if before is None:
                del os.environ["DOCKER_HOST"]
            else:
                os.environ["DOCKER_HOST"] = before

    def kill(self) -> None:
        assert self._process is not None
        self._process.kill()
        self._process.wait()

    def stop(self) -> None:
        assert self._process is not None
        self._process.send_signal(signal.SIGTERM)
        try:
            self._process.wait(30)
        except subprocess.TimeoutExpired:
            self.kill()
        for entry in Path("/proc").iterdir():  # the remains of a killed daemon
            if entry.name.isdigit():
                try:
                    if str(self.folder) in (entry / "cmdline").read_bytes().decode(
                        "utf-8", "replace"
                    ):
                        os.kill(int(entry.name), signal.SIGKILL)
                except OSError:
                    continue


@pytest.fixture
def daemon(client: DockerClient) -> Iterator[Daemon]:
    """A second daemon that has the image."""
    with tempfile.TemporaryDirectory(prefix="dockerd-", ignore_cleanup_errors=True) as name:
        second = Daemon(Path(name))
        second.start()
        try:
            loading = second.client()
            with tempfile.TemporaryFile() as packed:
                for piece in client.images.get(NAME).save(named=NAME):
                    packed.write(piece)
                packed.seek(0)
                loading.images.load(packed)
            loading.close()
            yield second
        finally:
            second.stop()
            for mount in re.findall(
                rf" ({re.escape(name)}/\S+) ", Path("/proc/mounts").read_text()
            ):
                subprocess.run(["umount", "-l", mount], check=False)


def test_a_killed_daemon_is_reported_and_its_remains_are_removed(
    daemon: Daemon, tmp_path: Path
) -> None:
    command = processes.grader("grade", SOLUTION, "--sandbox", "docker", "--out", tmp_path)
    environment = {
        **os.environ,
        "PYTHONPATH": str(processes.ROOT),
        "DOCKER_HOST": daemon.address,
    }
    grader = subprocess.Popen(command, env=environment, stderr=subprocess.PIPE, text=True)
    assert grader.stderr is not None
    for line in grader.stderr:
        if "building" in line:
            break
    daemon.kill()
    output = grader.stderr.read()
    assert grader.wait(60) == 3, output
    assert "the connection to the Docker daemon was lost" in output
    assert "Traceback" not in output

    daemon.start()
    again = processes.run(command, env={"DOCKER_HOST": daemon.address})
    assert again.returncode == 0, again.stdout + again.stderr
    left = daemon.client()
    assert left.api.containers(all=True, filters={"label": orphans.OWNER}) == []
    assert not left.api.volumes(filters={"label": orphans.OWNER})["Volumes"]
    left.close()
