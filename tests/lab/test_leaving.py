"""However the lab ends, none of its processes is left running."""

from __future__ import annotations

import json
import os
import secrets
import shlex
import signal
import subprocess
import time
from pathlib import Path

import pexpect
import pytest

from grader.base.folder import TEMPORARY
from grader.sandbox.processes import adopt_orphans
from lab.guide.progress import read_progress
from tests import processes
from tests.lab.helpers import SLOW, alive, run, start, until
from tests.lab.kinds import Kind, containers
from tests.lab.screen import PROMPT, Lab, command, environment


def test_kill_9_of_the_lab_leaves_nothing(kind: Kind, tmp_path: Path) -> None:
    mark = f"sleep 94{secrets.randbelow(10**6)}"
    workspace = tmp_path / "ws"
    lab = Lab(kind, workspace)
    lab.type(f"setsid {mark} & disown")
    start(lab, mark)
    until(lambda: len(alive(mark)) == 2)
    os.kill(lab.screen.pid, signal.SIGKILL)
    until(lambda: not alive(mark))
    if kind.sandbox == "docker":
        until(lambda: not containers(workspace))
    lab.screen.close(force=True)


@pytest.mark.long
@pytest.mark.parametrize("moment", range(20))
def test_killed_at_any_moment_nothing_is_lost(kind: Kind, tmp_path: Path, moment: int) -> None:
    """The student works and asks for hints; the lab is killed a bit later each time."""
    adopt_orphans()
    before = set(processes.descendants())
    workspace = tmp_path / "ws"
    env = {"GRADER_ASSIGNMENT": "hello_time"}
    with Lab(kind, workspace, env=env) as lab:
        lab.type("mkdir -p ~/ros2_ws/src; echo first > ~/ros2_ws/src/notes; lab hint > /dev/null")
        hints = read_progress(workspace).of("hello_time").hints
        assert sum(hints.values()) == 1
        lab.screen.sendline(
            "while :; do n=$((n + 1)); echo $n > ~/ros2_ws/src/new && mv ~/ros2_ws/src/{new,now}; "
            "lab hint > /dev/null; lab status > /dev/null; done"
        )
        until((workspace / "src/now").exists)
        time.sleep(0.15 * moment)  # any moment is a right one
        os.kill(lab.screen.pid, signal.SIGKILL)
    processes.wait_until_gone(before)
    if kind.sandbox == "docker":
        until(lambda: not containers(workspace))
    assert (workspace / "src/notes").read_text() == "first\n"
    assert int((workspace / "src/now").read_text()) >= 1
    json.loads((workspace / ".lab/progress.json").read_text())
    kept = read_progress(workspace).of("hello_time").hints
    assert all(kept[task] >= count for task, count in hints.items())
    with Lab(kind, workspace, env=env) as lab:
        assert lab.type("cat ~/ros2_ws/src/notes; lab hint > /dev/null") == "first\n"
    assert list((workspace / ".lab").glob(f"{TEMPORARY}*")) == []


@pytest.mark.parametrize("name", ["KILL", "TERM"])
def test_a_lab_that_ends_while_opening_leaves_nothing(tmp_path: Path, name: str) -> None:
    adopt_orphans()
    before = set(processes.descendants())
    own = environment(**processes.ends_as_bwrap_starts(tmp_path, name))
    words = command("--sandbox", "bubblewrap", "--workspace", tmp_path / "ws", "--", "cat")
    with subprocess.Popen(words, cwd=processes.ROOT, env=own, stdin=subprocess.PIPE) as opened:
        assert opened.wait(SLOW) in (-signal.SIGKILL, 143)
    processes.wait_until_gone(before)


def test_the_container_is_removed_when_the_lab_ends(docker_kind: Kind, tmp_path: Path) -> None:
    with Lab(docker_kind, tmp_path / "ws") as first, Lab(docker_kind, tmp_path / "ws") as second:
        assert containers(tmp_path / "ws") == ["running"]
        second.leave()
        assert containers(tmp_path / "ws") == ["running"]
        first.leave()
        assert containers(tmp_path / "ws") == []
    assert run(docker_kind, tmp_path / "ws", "--", "true").returncode == 0
    assert containers(tmp_path / "ws") == []


def test_closing_one_terminal_ends_only_its_own_programs(docker_kind: Kind, tmp_path: Path) -> None:
    one, other = (f"sleep 92{secrets.randbelow(10**6)}" for _ in range(2))
    with Lab(docker_kind, tmp_path / "ws") as first, Lab(docker_kind, tmp_path / "ws") as second:
        start(first, one)
        start(second, other)
        os.kill(first.screen.pid, signal.SIGKILL)
        until(lambda: not alive(one))
        until(lambda: len(alive(other)) == 1)
        second.interrupt()
        assert second.leave() == 0


def test_sigterm_closes_the_lab_and_restores_the_terminal(kind: Kind, tmp_path: Path) -> None:
    mark = f"sleep 93{secrets.randbelow(10**6)}"
    with Lab(kind, tmp_path / "ws") as lab:
        start(lab, mark)
        lab.screen.kill(signal.SIGTERM)
        lab.screen.expect(pexpect.EOF)
        lab.screen.close()
        assert lab.screen.exitstatus == 143
    until(lambda: not alive(mark))


def test_leaving_does_not_wait_for_background_jobs(kind: Kind, tmp_path: Path) -> None:
    marks = [f"sleep 91{secrets.randbelow(10**6)}" for _ in range(2)]
    with Lab(kind, tmp_path / "ws") as lab:
        lab.type(f"{marks[0]} &")
        lab.type(f"setsid {marks[1]} &")
        until(lambda: all(alive(mark) for mark in marks))
        assert lab.leave() == 0
    until(lambda: not any(alive(mark) for mark in marks))


def test_the_caller_gets_the_terminal_back(kind: Kind, tmp_path: Path) -> None:
    """A script that continues after the lab can read from the terminal in its original mode."""
    line = shlex.join(command("--sandbox", kind.sandbox, "--workspace", tmp_path / "ws"))
    script = (
        f'before=$(stty -g); {line}; [ "$before" = "$(stty -g)" ] && read -r x && echo "got $x"'
    )
    screen = pexpect.spawn(
        "bash",
        ["-c", script],
        cwd=str(processes.ROOT),
        env=environment(**kind.env),
        encoding="utf-8",
        timeout=SLOW,
    )
    screen.expect(PROMPT)
    screen.sendline("exit")
    screen.expect_exact("exit\r\n")
    screen.sendline("my words")
    screen.expect_exact("got my words")
    screen.expect(pexpect.EOF)
    screen.close()
