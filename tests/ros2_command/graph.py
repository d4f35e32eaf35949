"""Nodes of the wheels' rclpy, and `ros2` commands that look at them, in a domain of their own."""

from __future__ import annotations

import os
import signal
import subprocess
from pathlib import Path
from typing import NamedTuple

from tests.domains import new_domain

WORLD = Path(__file__).with_name("world.py")
LONGEST = 60  # seconds


class Done(NamedTuple):
    status: int
    stdout: str
    stderr: str


class Graph:
    """Programs in shells with a prefix sourced; `range_` is the nodes' discovery range."""

    def __init__(self, prefix: Path, folder: Path, *, range_: str = "LOCALHOST") -> None:
        self.prefix = prefix
        self._folder = folder
        self._environment = {
            **os.environ,
            "ROS_DOMAIN_ID": new_domain(),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": range_,
            "ROS_LOG_DIR": str(folder / "log"),
            "COLUMNS": "80",
        }
        self._started: list[subprocess.Popen[str]] = []

    def start(self, *command: str, ready: str = "ready\n") -> subprocess.Popen[str]:
        """Start a program and wait for its first line."""
        process = self._popen(*command)
        self._started.append(process)
        assert process.stdout is not None
        assert process.stdout.readline() == ready
        return process

    def run(self, *command: str, stdin: str = "") -> Done:
        process = self._popen(*command)
        stdout, stderr = process.communicate(stdin, timeout=LONGEST)
        return Done(process.returncode, stdout, stderr)

    def ros2(self, *arguments: str) -> Done:
        return self.run("ros2", *arguments)

    def interrupted(self, *command: str, after: str, times: int) -> Done:
        """Run a command, and press Ctrl+C when a line has been there so many times."""
        process = self._popen(*command)
        self._started.append(process)
        assert process.stdout is not None
        lines: list[str] = []
        left = times
        while left:
            line = process.stdout.readline()
            assert line, (lines, process.communicate()[1])
            lines.append(line)
            left -= line.startswith(after)
        os.killpg(process.pid, signal.SIGINT)
        stdout, stderr = process.communicate(timeout=LONGEST)
        return Done(process.returncode, "".join(lines) + stdout, stderr)

    def stop(self) -> None:
        for process in self._started:
            if process.poll() is None:
                process.kill()
            process.communicate()

    def _popen(self, *command: str) -> subprocess.Popen[str]:
        setup = str(self.prefix / "setup.bash")
        return subprocess.Popen(
            ["bash", "-c", 'source "$0" && exec "$@"', setup, *command],
            env=self._environment,
            cwd=self._folder,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )
