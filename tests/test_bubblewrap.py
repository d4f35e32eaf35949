"""The bubblewrap sandbox confines a submission and passes Ctrl+C on to it."""

from __future__ import annotations

import json
import os
import secrets
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from grader.ros.prefix import Ros
from grader.sandbox import bubblewrap
from grader.sandbox.base import Sandbox
from grader.sandbox.bubblewrap import Bubblewrap
from grader.sandbox.limits import Limits
from grader.sandbox.processes import adopt_orphans
from tests import processes
from tests.sandbox_contract import *  # noqa: F403 - the tests themselves


@pytest.fixture(scope="module")
def sandbox(ros_jazzy: Ros) -> Iterator[Sandbox]:
    """One sandbox for the contract: its commands end with each test."""
    with Bubblewrap(ros_jazzy, Limits()) as opened:
        yield opened


def test_closing_ends_every_process_and_removes_the_control_group(ros_jazzy: Ros) -> None:
    mark = f"sleep 97{secrets.randbelow(10**6)}"
    with Bubblewrap(ros_jazzy, Limits()) as opened:
        script = f"echo up; setsid {mark} & {mark}"
        command = opened.command(["bash", "-c", script])
        process = subprocess.Popen(command, stdout=subprocess.PIPE)
        assert process.stdout is not None
        assert process.stdout.readline() == b"up\n"
        groups = [Path(entry).parent for entry in opened._group.entries]
    process.wait(10)
    process.stdout.close()
    assert processes.alive(mark) == []
    assert not any(group.exists() for group in groups)


def test_where_the_kernel_has_no_layers_for_users_the_prefix_is_there_all_the_same(
    ros_jazzy: Ros, monkeypatch: pytest.MonkeyPatch
) -> None:
    without = bubblewrap.HOLD.replace("mount -t overlay", "mount -t no_such_file_system")
    monkeypatch.setattr(bubblewrap, "HOLD", without)
    with Bubblewrap(ros_jazzy, Limits()) as opened:
        place = "/opt/ros/jazzy"
        done = opened.run(
            ["sh", "-c", f"test -f {place}/setup.bash && touch {place}/x"], seconds=20
        )
        assert b"Read-only file system" in done.output
        assert b"/mnt" not in opened.run(["cat", "/proc/self/mounts"], seconds=20).output


KILLED = """
import sys, subprocess
from grader.sandbox.limits import Limits
from grader.ros.distro import find_distro
from grader.sandbox.proof import proven_ros
from grader.sandbox.bubblewrap import Bubblewrap
with Bubblewrap(proven_ros(find_distro("jazzy")), Limits()) as opened:
    command = opened.command(["bash", "-c", "echo up; setsid MARK & MARK"])
    subprocess.run(command)
"""


def test_kill_9_of_the_grader_leaves_nothing() -> None:
    mark = f"sleep 96{secrets.randbelow(10**6)}"
    grader = subprocess.Popen(
        [sys.executable, "-c", KILLED.replace("MARK", mark)],
        cwd=processes.ROOT,
        stdout=subprocess.PIPE,
    )
    assert grader.stdout is not None
    assert grader.stdout.readline() == b"up\n"
    grader.send_signal(signal.SIGKILL)
    grader.wait()
    # the sandbox has the pipe's write ends: it closes when every process in it has ended
    assert grader.stdout.read() == b""
    grader.stdout.close()
    assert [line for line in processes.alive(mark) if "bash -c" not in line] == []


@pytest.mark.parametrize("name", ["KILL", "INT"])
def test_a_grader_that_ends_while_the_sandbox_opens_leaves_nothing(
    tmp_path: Path, name: str
) -> None:
    adopt_orphans()
    before = set(processes.descendants())
    grader = subprocess.run(
        [sys.executable, "-c", KILLED],
        cwd=processes.ROOT,
        env=os.environ | processes.ends_as_bwrap_starts(tmp_path, name),
        capture_output=True,
        check=False,
    )
    number = signal.Signals["SIG" + name]
    assert grader.returncode == -number, grader.stderr
    processes.wait_until_gone(before)


def test_the_control_groups_of_a_killed_grader_are_removed(tmp_path: Path) -> None:
    from grader.sandbox.cgroups import open_group

    dead = subprocess.Popen(["true"])
    dead.wait()
    for controller in ("memory", "pids"):
        (tmp_path / controller).mkdir()
        (tmp_path / controller / "cgroup.procs").touch()
        (tmp_path / controller / "ros2_grader" / f"{dead.pid}-1").mkdir(parents=True)
        (tmp_path / controller / "ros2_grader" / f"{os.getpid()}-1").mkdir()
    open_group(Limits(), root=tmp_path)
    left = {path.name for path in tmp_path.glob("*/ros2_grader/*")}
    assert left == {f"{os.getpid()}-1"}


def test_an_ordinary_user_gets_the_same_sandbox(ros_jazzy: Ros) -> None:
    code = (
        "import json\n"
        "from grader.sandbox.limits import Limits\n"
        "from grader.ros.distro import find_distro\n"
        "from grader.ros.prefix import Ros, base_interpreter\n"
        "from grader.sandbox.bubblewrap import Bubblewrap\n"
        "from pathlib import Path\n"
        f"ros = Ros(find_distro('jazzy'), 'wheels', Path({str(ros_jazzy.path)!r}), "
        "base_interpreter(), {})\n"
        "with Bubblewrap(ros, Limits(processes=60)) as opened:\n"
        "    said = opened.run(['bash', '-c', 'id -u; cat /proc/net/dev | grep -c :; "
        'touch /usr/x; touch a; ls; python3 -c "import sys; print(sys.version_info[0])"\'], '
        "seconds=20)\n"
        "    probe = opened.run(['id', '-u'], role='probe', seconds=20)\n"
        "    bomb = opened.run(['bash', '-c', 'for i in $(seq 200); do sleep 50 & done; "
        "echo all'], seconds=4)\n"
        "    print(json.dumps([said.output.decode(), probe.output.decode(), "
        "bomb.output.decode(), opened.held_by()]))\n"
    )
    done = processes.run(processes.as_user([sys.executable, "-c", code]))
    assert done.returncode == 0, done.stderr
    output, probe, bomb, held = json.loads(done.stdout)
    assert output.split()[:2] == ["1000", "1"]
    assert "Read-only file system" in output
    assert output.split()[-2:] == ["a", "3"]
    assert probe.strip() == "1001"
    assert "all" not in bomb.split() or "Resource temporarily unavailable" in bomb
    assert held["processes"] in ("rlimit", "cgroup")


def test_a_machine_without_namespaces_is_reported_with_the_cause(
    ros_jazzy: Ros, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from grader.base.errors import SurroundingsError

    fake = tmp_path / "bwrap"
    fake.write_text("#!/bin/sh\necho 'bwrap: setting up uid map: Permission denied' >&2\nexit 1\n")
    fake.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}{os.pathsep}{os.environ['PATH']}")
    with pytest.raises(SurroundingsError) as caught, Bubblewrap(ros_jazzy, Limits()):
        pass
    assert "unprivileged user namespaces are not allowed" in str(caught.value)
    assert "root" in caught.value.remedy
