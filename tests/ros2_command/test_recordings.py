"""Every recording of the real ros2cli 0.32.2, replayed against our command."""

from __future__ import annotations

import json
import os
import re
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pexpect
import pytest

from grader.sandbox.processes import children_of
from tests.processes import wait_until_asleep

from .surroundings import Surroundings, files, running, without_places

CASES: list[dict[str, Any]] = json.loads(
    (Path(__file__).parents[1] / "recordings" / "ros2cli-jazzy.json").read_text()
)["cases"]
BY_NAME = {case["name"]: case for case in CASES}
OUTPUT = [case["name"] for case in CASES if "stdout" in case]
TYPED = [case["name"] for case in CASES if "after" in case]
SIGNALLED = [case["name"] for case in CASES if "ros2_alive" in case]

# "create again" is recorded in the folder of "create first", the others in separate ones
BEFORE = {"create again": "create first"}
FOLDERS = {"create first": "twice", "create again": "twice"}
# These files have our own wording, so their sizes differ
OWN_TEXT = re.compile(r"/test/test_\w+\.py$")
# ros2cli 0.32.6 changed this in setup.py, and nothing else (ros2cli#1066); ours is as since then
BEFORE_0_32_6 = "    tests_require=['pytest'],\n"
SINCE_0_32_6 = (
    "    extras_require={\n        'test': [\n            'pytest',\n        ],\n    },\n"
)


def test_every_recording_is_replayed() -> None:
    assert len(CASES) == 37
    assert sorted(OUTPUT + TYPED + SIGNALLED) == sorted(BY_NAME)


# The recorded command had only these packages: ros2cli, ros2node, ros2pkg, ros2run, ros2topic
CHOICE = re.compile(r"'(\w+)'(?=[,)])")


def without_choices(error: str) -> str:
    return re.sub(r"\(choose from .*\)", "(choose from …)", error)


def since_0_32_6(setup: dict[str, Any]) -> dict[str, Any]:
    """Return what is recorded of a setup.py as ros2cli 0.32.6 would have written it."""
    arguments = dict(setup["setup_arguments"])
    assert arguments.pop("tests_require") == "['pytest']"
    return {
        **setup,
        "bytes": setup["bytes"] + len(SINCE_0_32_6) - len(BEFORE_0_32_6),
        "setup_arguments": {**arguments, "extras_require": "{'test': ['pytest']}"},
    }


@pytest.mark.parametrize("name", OUTPUT)
def test_output_status_and_files_are_the_recorded_ones(jazzy: Surroundings, name: str) -> None:
    case = BY_NAME[name]
    cwd = jazzy.root / FOLDERS.get(name, re.sub(r"\W", "_", name))
    cwd.mkdir()
    if "src" in case["argv"]:
        (cwd / "src").mkdir()
    if name in BEFORE:
        jazzy.ros2(*BY_NAME[BEFORE[name]]["argv"][1:], cwd=cwd)
    if name == "run without exec bit":
        (jazzy.executables / "three").chmod(0o644)

    done = jazzy.ros2(*case["argv"][1:], cwd=cwd)

    assert jazzy.normalised(done.stdout) == case["stdout"]
    assert without_choices(jazzy.normalised(done.stderr)) == without_choices(case["stderr"])
    assert set(CHOICE.findall(done.stderr)) >= set(CHOICE.findall(case["stderr"]))
    assert done.status == case["status"]
    if "created" in case:
        created = files(cwd)
        assert list(created) == sorted(case["created"])
        for path, former in case["created"].items():
            recorded = since_0_32_6(former) if path.endswith("/setup.py") else former
            ignored = {"bytes"} if OWN_TEXT.search(path) else set()
            assert {k: v for k, v in created[path].items() if k not in ignored} == {
                k: v for k, v in recorded.items() if k not in ignored
            }, path


@contextmanager
def on_a_terminal(jazzy: Surroundings, *command: str) -> Iterator[pexpect.spawn[str]]:
    terminal: pexpect.spawn[str] = pexpect.spawn(
        command[0],
        list(command[1:]),
        env=jazzy.environment,
        encoding="utf-8",
        timeout=30,
        dimensions=(40, 200),
    )
    try:
        yield terminal
    finally:
        terminal.close(force=True)


@pytest.mark.parametrize("name", TYPED)
def test_ctrl_c_on_the_terminal_ends_as_recorded(jazzy: Surroundings, name: str) -> None:
    case = BY_NAME[name]
    executable = case["argv"][-1]
    ros2 = str(jazzy.prefix / "bin" / "ros2")
    with on_a_terminal(jazzy, ros2, "run", "my_robot_controller", executable) as terminal:
        terminal.expect_exact({"wait": "waiting", "hang": "hanging"}[executable] + "\r\n")
        (node,) = children_of(terminal.pid)
        wait_until_asleep(node)
        terminal.sendintr()
        terminal.expect(pexpect.EOF)
        after = terminal.before
        terminal.wait()

    assert terminal.exitstatus == case["status"]
    assert terminal.signalstatus == case["signal"]
    if executable == "wait":
        assert after == case["after"]
    else:
        # the recording has the last part of the traceback of Python 3.12
        recorded = without_places(case["after"].partition("\r\n")[2])
        assert without_places(after).endswith(recorded)
        if sys.version_info[:2] == (3, 12):  # 3.10 has no ^^^^, 3.13 mixes them with ~~~~
            assert jazzy.normalised(after).endswith(case["after"])


@pytest.mark.parametrize("name", SIGNALLED)
def test_a_signal_to_ros2_alone_ends_as_recorded(jazzy: Surroundings, name: str) -> None:
    case = BY_NAME[name]
    number = signal.SIGINT if "SIGINT" in name else signal.SIGTERM
    # A shell stays on the terminal, as a student's does: the end of the terminal's first process
    # would end the node as well.
    line = "ros2 run my_robot_controller hang; echo status $?; read line"
    with on_a_terminal(jazzy, "/bin/sh", "-c", line) as terminal:
        terminal.expect_exact("hanging\r\n")
        (ros2,) = children_of(terminal.pid)
        (node,) = children_of(ros2)
        wait_until_asleep(ros2)
        os.kill(ros2, number)
        if case["ros2_alive"]:
            _let_handle(ros2, number)
        else:
            terminal.expect_exact(f"status {128 - case['status']}\r\n")
        assert (running(ros2), running(node)) == (case["ros2_alive"], case["node_alive"])
        os.kill(node, signal.SIGKILL)


def _let_handle(process: int, number: int) -> None:
    """Wait until this signal is no longer pending for the process."""
    while _pending(process) & 1 << (number - 1):
        os.sched_yield()


def _pending(process: int) -> int:
    lines = Path(f"/proc/{process}/status").read_text().splitlines()
    return sum(int(line.split()[1], 16) for line in lines if line.startswith(("SigPnd", "ShdPnd")))
