"""The `docker` sandbox meets the sandbox contract and leaves nothing behind."""

from __future__ import annotations

import json
import os
import secrets
import signal
import subprocess
import sys
import time
from collections.abc import Callable

import docker.errors
import pytest
from docker import DockerClient

from grader.sandbox import orphans
from grader.sandbox.base import Sandbox
from grader.sandbox.limits import Limits
from grader.sandbox.seccomp import docker_profile
from tests import engine, processes
from tests.sandbox_contract import *  # noqa: F403 - the tests themselves
from tests.sandbox_contract import shell

pytestmark = [pytest.mark.docker]
GONE_SECONDS = 15.0
SOLUTION = processes.ROOT / "grader" / "keys" / "hello_time" / "solution" / "my_robot_controller"


def made_by(client: DockerClient, pid: int, *, state: str = "") -> list[str]:
    """Return the remaining containers and volumes that a process has made."""

    def is_its(labels: dict[str, str] | None) -> bool:
        return (labels or {}).get(orphans.OWNER, "").split()[1:2] == [str(pid)]

    containers = client.api.containers(all=True, filters={"label": orphans.OWNER})
    volumes = client.api.volumes(filters={"label": orphans.OWNER})["Volumes"] or ()
    found = [
        str(each["Names"])
        for each in containers
        if is_its(each["Labels"]) and state in ("", each["State"])
    ]
    if state:
        return found
    return found + [str(each["Name"]) for each in volumes if is_its(each["Labels"])]


def wait_until_gone(client: DockerClient, pid: int, *, state: str = "") -> list[str]:
    deadline = time.monotonic() + GONE_SECONDS
    while (left := made_by(client, pid, state=state)) and time.monotonic() < deadline:
        time.sleep(0.05)  # the daemon removes them itself
    return left


def test_the_system_is_locked_down(sandbox: Sandbox, client: DockerClient) -> None:
    shell(sandbox, "true")
    mine = client.containers.list(
        filters={"label": f"{orphans.OWNER}={orphans.labels(0)[orphans.OWNER]}"}
    )
    assert len(mine) >= 2
    for container in mine:
        container.reload()
        host = container.attrs["HostConfig"]
        assert host["ReadonlyRootfs"] is True
        assert host["CapDrop"] == ["ALL"]
        assert not host["CapAdd"]
        assert not host["Binds"]
        assert host["Privileged"] is False
        assert host["NetworkMode"].split(":")[0] in ("none", "container")
        assert host["SecurityOpt"] == ["no-new-privileges", f"seccomp={docker_profile()}"]
        assert host["Memory"] == host["MemorySwap"] == Limits().memory
        assert host["PidsLimit"] == Limits().processes
        assert host["NanoCpus"] > 0
        assert host["Init"] is True
        assert host["AutoRemove"] is True
        assert container.attrs["Config"]["User"].split(":")[0] not in ("", "0", "root")
    _, output = shell(sandbox, "grep Seccomp: /proc/self/status; grep -c . /proc/self/mountinfo")
    assert output.split()[1] == "2"


def test_the_first_process_cannot_be_ended_by_the_submission(sandbox: Sandbox) -> None:
    first_process = "ls -l /proc/[0-9]*/exe 2> /dev/null; grep -l timeout /proc/[0-9]*/comm"
    _, before = shell(sandbox, first_process)
    assert "/comm" in before
    kill = "for p in /proc/[0-9]*; do kill -9 ${p#/proc/}; done; kill -9 -1"
    shell(sandbox, kill)
    _, after = shell(sandbox, first_process)
    assert [line for line in after.split() if line.endswith("/comm")] == [
        line for line in before.split() if line.endswith("/comm")
    ]


def test_a_limit_that_ends_the_probe_is_detected(make_sandbox: Callable[[Limits], Sandbox]) -> None:
    hog = "x = bytearray(500_000_000); x[::4096] = b'1' * len(x[::4096])"
    with make_sandbox(Limits(memory=80_000_000)) as opened:
        assert opened.probe_limit_hit() == ""
        probe = opened.probe(["python3", "-S", "-c", hog])
        assert probe.read(20) == b""
        assert opened.probe_limit_hit() == "memory"
        probe.finish(1)


def test_closing_leaves_nothing_behind(
    make_sandbox: Callable[[Limits], Sandbox], client: DockerClient
) -> None:
    before = made_by(client, os.getpid())
    with make_sandbox(Limits()) as opened:
        shell(opened, "setsid sleep 300 & echo up")
        assert len(made_by(client, os.getpid())) > len(before)
    assert made_by(client, os.getpid()) == before


SLOW = 'import time\nprint("building", flush=True)\ntime.sleep(300)\n'


@pytest.fixture
def slow_build(tmp_path: object) -> Callable[[], subprocess.Popen[str]]:
    """A function that starts a grader in Docker on a package whose build does not end."""
    from pathlib import Path
    from shutil import copytree

    package = Path(str(tmp_path)) / "slow" / "my_robot_controller"
    copytree(SOLUTION, package)
    setup = package / "setup.py"
    setup.write_text(SLOW + setup.read_text())

    def start() -> subprocess.Popen[str]:
        command = processes.grader("grade", package, "--sandbox", "docker", "--out", str(tmp_path))
        environment = {**os.environ, "PYTHONPATH": str(processes.ROOT)}
        return subprocess.Popen(
            command, env=environment, stderr=subprocess.PIPE, text=True, start_new_session=True
        )

    return start


@pytest.mark.parametrize(
    ("sent", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGKILL, -9)]
)
def test_nothing_is_left_however_the_grader_ends(
    slow_build: Callable[[], subprocess.Popen[str]],
    client: DockerClient,
    sent: signal.Signals,
    status: int,
) -> None:
    grader = slow_build()
    assert grader.stderr is not None
    for line in grader.stderr:
        if "building" in line:
            break
    deadline = time.monotonic() + GONE_SECONDS
    while not made_by(client, grader.pid) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert made_by(client, grader.pid)
    grader.send_signal(sent)
    output = grader.stderr.read()
    assert grader.wait(30) == status, output
    assert "Traceback" not in output
    assert wait_until_gone(client, grader.pid, state="running") == []
    orphans.remove_orphans(client)  # as the next grader does: one that was never started is left
    assert wait_until_gone(client, grader.pid) == []


def test_only_the_remains_of_an_ended_grader_are_removed(
    make_sandbox: Callable[[Limits], Sandbox], client: DockerClient
) -> None:
    dead = subprocess.run(
        [
            sys.executable,
            "-c",
            "import json; from grader.sandbox import orphans; "
            "print(json.dumps(orphans.labels(1000)))",
        ],
        cwd=processes.ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    image = f"{engine.REPOSITORY}:base"
    mark = secrets.token_hex(6)
    ours = client.containers.create(image, "true", labels=json.loads(dead.stdout))
    volume = client.volumes.create(labels=json.loads(dead.stdout))
    foreign = client.containers.create(image, "true", labels={"somebody": mark})
    living = client.containers.create(image, "true", labels=orphans.labels(1000))
    try:
        with make_sandbox(Limits()):
            pass
        with pytest.raises(docker.errors.NotFound):
            ours.reload()
        with pytest.raises(docker.errors.NotFound):
            volume.reload()
        foreign.reload()
        living.reload()
    finally:
        foreign.remove()
        living.remove()


def test_containers_of_another_machine_are_kept_for_a_while() -> None:
    label = {orphans.OWNER: "another-boot/1 1 1", orphans.UNTIL: str(int(time.time()) + 100)}
    assert not orphans.is_orphan(label)
    assert orphans.is_orphan(label | {orphans.UNTIL: str(int(time.time()) - 1)})
    assert not orphans.is_orphan({"other": "label"})
    assert not orphans.is_orphan({orphans.OWNER: "nonsense", orphans.UNTIL: "x"})
