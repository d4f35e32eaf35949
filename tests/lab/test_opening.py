"""Which lab is opened, where its workspace is, and what is refused."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

from grader.ros.prefix import Ros
from tests import processes
from tests.lab import ten_steps
from tests.lab.kinds import Kind
from tests.lab.screen import Lab, command, environment
from tests.lab.workspaces import open_to_all

NO_DAEMON = {"DOCKER_HOST": "unix:///nonexistent/docker.sock"}
NO_IMAGE = {"GRADER_IMAGES": "no-such-repository"}


def lab(
    *words: str | Path, user: bool = False, env: Mapping[str, str] | None = None
) -> subprocess.CompletedProcess[str]:
    """Run the lab without a terminal."""
    line = command(*words)
    own = environment(**(env or {}))
    return processes.run(processes.as_user(line) if user else line, env=own, timeout=90)


def test_help_is_quick_to_load_and_names_the_options() -> None:
    code = "import sys, lab.cli; lab.cli.main(['--help']); sys.exit('pydantic' in sys.modules)"
    done = processes.run([sys.executable, "-c", code])
    assert done.returncode == 0
    for option in ("--distro", "--workspace", "--sandbox"):
        assert option in done.stdout


@pytest.mark.parametrize(
    ("words", "output"),
    [
        (["--distro", "jazy"], "did you mean 'jazzy'?"),
        (["--sandbox", "bubblewarp"], "did you mean 'bubblewrap'?"),
        (["--sandbox", "none"], "Sandboxes: auto, docker, bubblewrap."),
        (["--wrkspace", "x"], "--workspace"),
        (["--sandbox", "bubblewrap", "--workspace", "/"], "/ cannot be a workspace"),
        (["--sandbox", "bubblewrap", "--workspace", "~"], "it is your home folder"),
        (["--sandbox", "bubblewrap", "--workspace", "~/.."], "cannot be a workspace"),
        (["--sandbox", "bubblewrap", "--workspace", "/etc/passwd"], "/etc/passwd is a file"),
        (["--sandbox", "bubblewrap", "--workspace", "/etc/passwd/ws"], "cannot be created"),
        (["--sandbox", "bubblewrap", "--workspace", "/proc/ws"], "cannot be created"),
    ],
)
def test_usage_errors_say_what_to_do(words: list[str], output: str, ros_jazzy: Ros) -> None:
    done = lab(*words, "--", "true")
    assert done.returncode == 2
    assert output in done.stderr
    assert "Traceback" not in done.stderr
    assert done.stdout == ""


def test_auto_without_a_daemon_opens_bubblewrap_and_says_why(
    ros_jazzy: Ros, tmp_path: Path
) -> None:
    done = lab("--workspace", tmp_path / "ws", "--", "echo", "inside", env=NO_DAEMON)
    assert (done.returncode, done.stdout) == (0, "inside\n")
    (line,) = done.stderr.splitlines()
    assert line.startswith("lab: opening ROS 2 jazzy in bubblewrap because ")


def test_docker_without_a_daemon_is_reported(tmp_path: Path) -> None:
    done = lab("--sandbox", "docker", "--workspace", tmp_path / "ws", "--", "true", env=NO_DAEMON)
    assert done.returncode == 3
    assert "Traceback" not in done.stderr
    assert not (tmp_path / "ws").exists()


def test_a_distro_without_wheels_and_without_docker_says_what_it_needs(tmp_path: Path) -> None:
    done = lab("--distro", "humble", "--workspace", tmp_path / "ws", "--", "true", env=NO_DAEMON)
    assert done.returncode == 3
    assert "humble has no wheels on PyPI, so its lab needs Docker" in done.stderr
    assert "SANDBOX=bubblewrap" not in done.stderr, "which has no ROS humble either"
    assert "DISTRO=jazzy" in done.stderr


@pytest.mark.parametrize("distro", ["humble", "jazzy"])
def test_without_docker_only_what_works_is_recommended(distro: str, tmp_path: Path) -> None:
    words = ["--distro", distro, "--sandbox", "docker", "--workspace", str(tmp_path / "ws")]
    done = lab(*words, "--", "true", env=NO_DAEMON)
    assert done.returncode == 3
    assert ("SANDBOX=bubblewrap" in done.stderr) == (distro == "jazzy")


@pytest.mark.docker
def test_docker_without_an_image_names_the_command_that_builds_it(
    ros_jazzy: Ros, tmp_path: Path
) -> None:
    words: list[str | Path] = ["--workspace", tmp_path / "ws", "--", "echo", "inside"]
    done = lab("--sandbox", "docker", *words, env=NO_IMAGE)
    assert done.returncode == 3
    assert "make images DISTRO=jazzy" in done.stderr
    done = lab(*words, env=NO_IMAGE)
    assert (done.returncode, done.stdout) == (0, "inside\n")
    assert "in bubblewrap because Docker has no lab image" in done.stderr


@pytest.mark.docker
def test_a_daemon_on_another_machine_is_refused() -> None:
    """The test uses this machine's daemon under another host name."""
    code = (
        "import docker, lab.container as c\n"
        "client = docker.from_env()\n"
        "client.api.base_url = 'https://10.0.0.1:2376'\n"
        "c._require_local_daemon(client)\n"
    )
    done = processes.run([sys.executable, "-c", code])
    assert "is not on this machine (https://10.0.0.1:2376)" in done.stderr


def test_the_default_workspace_is_ros2_ws_in_the_callers_home(ros_jazzy: Ros) -> None:
    with open_to_all() as home:
        done = lab("--sandbox", "bubblewrap", "--", "true", env={"HOME": str(home)})
        assert done.returncode == 0, done.stderr
        assert (home / "ros2_ws" / "src").is_dir()


def test_an_existing_workspace_is_used_and_not_changed(kind: Kind, tmp_path: Path) -> None:
    with open_to_all() as folder:
        workspace = folder / "ws"
        (workspace / "src").mkdir(parents=True)
        (workspace / "src" / "notes").write_text("mine")
        (workspace / "build").symlink_to("/nowhere")
        if os.geteuid() == 0:
            for path in (workspace, workspace / "src", workspace / "src" / "notes"):
                os.chown(path, 4321, 4322)
        own = (workspace / "src", *workspace.rglob("src/*"), workspace / "build")
        before = {path: path.lstat() for path in own}
        words: list[str | Path] = ["--sandbox", kind.sandbox, "--workspace", workspace, "--"]
        done = lab(*words, "sh", "-c", "id -u; id -g; whoami; cat src/notes", env=kind.env)
        uid, gid, name, text = done.stdout.splitlines()
        assert (name, text) == ("student", "mine")
        if os.geteuid() == 0:  # root's lab belongs to the workspace's owner
            assert (uid, gid) == ("4321", "4322")
        assert {path.name for path in workspace.iterdir()} == {"src", "build", ".lab"}
        kept = {s.lstat().st_uid for s in (workspace / ".lab").rglob("*")}
        assert kept == {before[own[0]].st_uid}
        after = {path: path.lstat() for path in own}
        assert {path: (s.st_mtime_ns, s.st_uid, s.st_mode) for path, s in before.items()} == {
            path: (s.st_mtime_ns, s.st_uid, s.st_mode) for path, s in after.items()
        }


@pytest.mark.full  # needs root, which `make test` does not
def test_under_sudo_the_files_belong_to_the_caller(kind: Kind) -> None:
    with open_to_all() as folder:
        workspace = folder / "deep" / "er" / "ws"
        who = {"SUDO_UID": "4321", "SUDO_GID": "4322"}
        words: list[str | Path] = [
            "--sandbox",
            kind.sandbox,
            "--workspace",
            workspace,
            "--",
            "touch",
            "src/made",
        ]
        assert lab(*words, env={**who, **kind.env}).returncode == 0
        assert ten_steps.owners(folder / "deep") == {4321}


@pytest.mark.full  # needs root, which `make test` does not
def test_a_workspace_owned_by_root_is_refused_and_not_changed(
    ros_jazzy: Ros, tmp_path: Path
) -> None:
    (tmp_path / "ws" / "src").mkdir(parents=True)
    done = lab("--sandbox", "bubblewrap", "--workspace", tmp_path / "ws", "--", "true")
    assert done.returncode == 2
    assert "chown" in done.stderr
    assert ten_steps.owners(tmp_path / "ws") == {0}


def test_a_workspace_that_its_student_cannot_write_is_refused(ros_jazzy: Ros) -> None:
    with open_to_all() as folder:
        (folder / "ws" / "src").mkdir(parents=True)
        (folder / "ws").chmod(0o555)
        words: list[str | Path] = [
            "--sandbox",
            "bubblewrap",
            "--workspace",
            folder / "ws",
            "--",
            "true",
        ]
        done = lab(*words, user=True)
        assert done.returncode == 2
        assert "cannot write to the workspace folder" in done.stderr
        words[3] = folder / "ws" / "below"
        done = lab(*words, user=True)
        assert done.returncode == 2
        assert "cannot be created: Permission denied" in done.stderr


def test_a_forbidden_bubblewrap_is_reported_with_cause_and_fix(
    ros_jazzy: Ros, tmp_path: Path
) -> None:
    fake = tmp_path / "bin" / "bwrap"
    fake.parent.mkdir()
    fake.write_text("#!/bin/sh\necho 'bwrap: setting up uid map: Permission denied' >&2\nexit 1\n")
    fake.chmod(0o755)
    path = f"{fake.parent}{os.pathsep}{os.environ['PATH']}"
    done = lab(
        "--sandbox", "bubblewrap", "--workspace", tmp_path / "ws", "--", "true", env={"PATH": path}
    )
    assert done.returncode == 3
    assert "unprivileged user namespaces are not allowed" in done.stderr


def test_an_interactive_lab_does_not_exit_with_the_last_commands_status(
    ros_jazzy: Ros, tmp_path: Path
) -> None:
    """Otherwise `make lab` would end with an error message."""
    with Lab(Kind("bubblewrap"), tmp_path / "ws") as opened:
        opened.type("false")
        assert opened.leave() == 0
