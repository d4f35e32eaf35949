"""`account` and `none`: their guarantees without namespaces, and their refusals."""

from __future__ import annotations

import json
import os
import secrets
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from grader.base.cache import cache_root
from grader.base.errors import SurroundingsError, UsageError
from grader.ros.distro import find_distro
from grader.ros.prefix import Ros, prefix_path
from grader.sandbox import plain
from grader.sandbox.base import Sandbox
from grader.sandbox.choose import open_sandbox
from grader.sandbox.limits import Limits
from grader.sandbox.plain import NoSandbox
from tests import processes
from tests import sandbox_contract as contract
from tests.test_cli import solution


def test_two_graders_of_a_machine_never_share_a_domain_whatever_their_tmp(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(plain, "DOMAINS", [plain.DOMAINS[-1] + 1])  # (nobody else asks for it)
    first, lock = plain.lock_domain()
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))  # as in another lab
    try:
        with pytest.raises(SurroundingsError, match="every ROS domain"):
            plain.lock_domain()
    finally:
        os.close(lock)
    again, lock = plain.lock_domain()
    os.close(lock)
    assert again == first


ACCOUNT = """
import json, sys
from grader.sandbox.limits import Limits
from grader.ros.distro import find_distro
from grader.sandbox.proof import proven_ros
from grader.sandbox.plain import AccountSandbox
mark = sys.argv[1]
with AccountSandbox(proven_ros(find_distro("jazzy")), Limits(processes=60)) as opened:
    def said(script, role="student", seconds=20):
        return opened.run(["bash", "-c", script], role=role, seconds=seconds).output.decode()
    out = {
        "uids": [said("id -u").strip(), said("id -u", "probe").strip()],
        "here": said("pwd; touch a; ls"),
        "probe_cannot": said("touch %s/b" % opened.workspace, "probe"),
        "student_cannot": said("kill -9 1; touch /usr/x /opt/x; grep CapEff /proc/self/status"),
        "ros": said(". /opt/ros/jazzy/setup.bash; python3 -c 'import rclpy; print(rclpy.__name__)'"),
        "left": said("setsid %s > /dev/null 2>&1 < /dev/null & echo started" % mark),
        "bomb": said("for i in $(seq 200); do sleep 50 & done; echo all", seconds=4),
        "env": sorted(line.partition("=")[0] for line in said("env").splitlines()),
        "folder": str(opened.folder),
    }
print(json.dumps(out))
"""


@pytest.mark.full  # needs root, which `make test` does not
def test_account_runs_student_and_probe_as_two_other_users(ros_jazzy: Ros) -> None:
    mark = f"sleep 95{secrets.randbelow(10**6)}"
    command = processes.as_root_of_a_container([sys.executable, "-c", ACCOUNT, mark])
    done = processes.run(command, env={"SECRET_TOKEN": "abc"})
    assert done.returncode == 0, done.stderr
    output = json.loads(done.stdout)
    student, probe = output["uids"]
    assert student != probe
    assert "0" not in (student, probe)
    assert output["here"].split()[1:] == ["a"]
    assert "Permission denied" in output["probe_cannot"]
    assert "Operation not permitted" in output["student_cannot"]
    assert "CapEff:\t0000000000000000" in output["student_cannot"]
    assert output["ros"].strip() == "rclpy"
    assert "SECRET_TOKEN" not in output["env"]
    assert "all" not in output["bomb"].split() or "unavailable" in output["bomb"]
    assert processes.alive(mark) == []
    assert not Path(output["folder"]).exists()


TWO_ACCOUNTS = """
from pathlib import Path
from grader.sandbox.limits import Limits
from grader.ros.distro import find_distro
from grader.sandbox.plain import AccountSandbox
from grader.sandbox.proof import proven_ros
distro = find_distro("jazzy")
link = Path("/opt/ros/jazzy")
link.parent.mkdir()
link.symlink_to("/what/a/killed/grader/left")
for _ in range(2):
    with AccountSandbox(proven_ros(distro), Limits()) as first:
        with AccountSandbox(proven_ros(distro), Limits()) as second:
            first.close()
            script = '. "%s/setup.bash"; ros2 pkg prefix rclpy' % second.ros_path
            said = second.run(["bash", "-c", script], seconds=20)
            print(said.output.decode().strip() == second.ros_path)
    link.unlink(missing_ok=True)  # then the first makes it, and removes it before the second ends
"""


@pytest.mark.full  # needs root, which `make test` does not
def test_two_graders_with_accounts_do_not_depend_on_each_others_link(ros_jazzy: Ros) -> None:
    command = processes.as_root_of_a_container([sys.executable, "-c", TWO_ACCOUNTS])
    done = processes.run(command)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == ["True", "True"]


def test_account_needs_root(ros_jazzy: Ros, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GRADER_CACHE", str(cache_root()))  # another user's would be made now
    monkeypatch.setattr("os.geteuid", lambda: 1000)
    with pytest.raises(SurroundingsError, match="needs root"):
        open_sandbox("account", find_distro("jazzy"), Limits())


def test_without_a_sandbox_every_process_still_ends(ros_jazzy: Ros) -> None:
    mark = f"sleep 94{secrets.randbelow(10**6)}"
    with NoSandbox(ros_jazzy, Limits()) as opened:
        # it says up when it has left the group, which ends with the command
        escaped = f"setsid sh -c 'echo up; exec {mark} > /dev/null 2>&1 < /dev/null'"
        outcome = opened.run(["bash", "-c", f"read < <({escaped}); pwd"], seconds=10)
        folder = Path(opened.workspace).parent.parent
        assert outcome.output.decode().strip() == opened.workspace
        processes.wait_until_alive(mark)
    assert processes.alive(mark) == []
    assert not folder.exists()


def test_without_a_sandbox_the_environment_has_only_listed_variables(
    ros_jazzy: Ros, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PYTHONPATH", "/own")
    with NoSandbox(ros_jazzy, Limits()) as opened:
        output = opened.run(["env"], seconds=10).output.decode()
        assert "PYTHONPATH" not in output
        ros = opened.run(
            ["bash", "-c", f'. "{opened.ros_path}/setup.bash"; ros2 pkg prefix rclpy'], seconds=10
        )
        assert ros.output.decode().strip() == opened.ros_path


@pytest.mark.prefix
@pytest.mark.parametrize(
    "name",
    [
        pytest.param("it's $HOME `id`", marks=pytest.mark.full),
        *(
            pytest.param(name, marks=pytest.mark.long)
            for name in ("some path ü", "l" * 150, 'a "b":c', "a\nb")
        ),
    ],
)
def test_without_a_sandbox_odd_paths_work(
    name: str, ros_jazzy: Ros, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Both the prefix and TMPDIR may be odd: the student's own scripts have a short path."""
    odd = tmp_path / name
    monkeypatch.setenv("GRADER_CACHE", str(odd / "cache"))
    prefix = prefix_path(find_distro("jazzy"))
    prefix.parent.mkdir(parents=True)
    prefix.symlink_to(ros_jazzy.path)
    command = processes.grader(
        "grade", solution(tmp_path), "--sandbox", "none", "--out", odd / "out"
    )
    done = processes.run(command, env={"TMPDIR": str(odd)})
    assert done.returncode == 0, done.stdout + done.stderr
    assert "100 / 100" in done.stdout


@pytest.mark.parametrize(
    "holds",
    [
        contract.test_output_without_a_line_end_extends_no_wait,
        contract.test_a_pipe_without_a_complete_line_extends_no_wait,
        contract.test_unread_stderr_does_not_block_a_pipe,
    ],
)
def test_without_a_sandbox_no_output_extends_a_wait(
    ros_jazzy: Ros, holds: Callable[[Sandbox], None]
) -> None:
    with NoSandbox(ros_jazzy, Limits()) as opened:
        holds(opened)


def test_auto_never_marks_without_a_sandbox(
    ros_jazzy: Ros, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("shutil.which", lambda name: None)
    with pytest.raises(SurroundingsError) as caught:
        open_sandbox("auto", find_distro("jazzy"), Limits())
    assert "bwrap is missing" in caught.value.message
    assert "apt-get install bubblewrap" in caught.value.remedy


def test_own_code_may_run_without_a_sandbox(
    ros_jazzy: Ros, monkeypatch: pytest.MonkeyPatch
) -> None:
    import shutil

    real = shutil.which
    monkeypatch.setattr("shutil.which", lambda name: None if name == "bwrap" else real(name))
    opened = open_sandbox("auto", find_distro("jazzy"), Limits(), own_code=True)
    opened.close()
    assert opened.name == "none"


def test_a_misspelt_sandbox_gets_a_suggestion(ros_jazzy: Ros) -> None:
    with pytest.raises(UsageError) as caught:
        open_sandbox("bublewrap", find_distro("jazzy"), Limits())
    assert "did you mean 'bubblewrap'?" in caught.value.remedy
