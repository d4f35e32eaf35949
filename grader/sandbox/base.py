"""The small interface that every sandbox offers: open it, start commands, stop them all, close."""

from __future__ import annotations

import contextlib
import os
import selectors
import signal
import subprocess
import time
from abc import ABC
from abc import abstractmethod
from collections.abc import Mapping
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from grader.errors import SurroundingsError
from grader.limits import UNITS
from grader.limits import Limits
from grader.report.model import LimitInfo
from grader.ros.prefix import Ros

Role = Literal["student", "probe"]
HOME = "/home/student"
END_SECONDS = 2.0  # in which a command that was killed is gone
PATH = "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"

DISCOVERY_PROFILE = """<?xml version="1.0" encoding="UTF-8"?>
<profiles xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles">
  <transport_descriptors>
    <transport_descriptor>
      <transport_id>udp4</transport_id>
      <type>UDPv4</type>
    </transport_descriptor>
  </transport_descriptors>
  <participant profile_name="grader" is_default_profile="true">
    <rtps>
      <useBuiltinTransports>false</useBuiltinTransports>
      <userTransports><transport_id>udp4</transport_id></userTransports>
      <builtin>
        <discovery_config>
          <initialAnnouncements>
            <count>20</count>
            <period><sec>0</sec><nanosec>20000000</nanosec></period>
          </initialAnnouncements>
          <leaseAnnouncement><sec>0</sec><nanosec>100000000</nanosec></leaseAnnouncement>
        </discovery_config>
      </builtin>
    </rtps>
  </participant>
</profiles>
"""
"""A Fast DDS profile for node and probe: UDP alone, since shared memory does not reach across
namespaces, and quick announcements, since a lost first one costs 3 s otherwise."""


@dataclass(frozen=True)
class Outcome:
    """How a command ended: `status` is None where a limit ended it, `stopped_by` says which."""

    status: int | None
    output: bytes
    seconds: float
    stopped_by: str = ""


class Sandbox(ABC):
    """A sandbox over one workspace.

    `command` turns a command into one that runs inside when it is started on this machine, so
    that pipes and pseudo-terminals are the caller's own. Leaving the `with` block ends everything
    that was started in it.
    """

    name: str = ""

    def __init__(self, ros: Ros, limits: Limits) -> None:
        self.ros = ros
        self.limits = limits

    def __enter__(self) -> Sandbox:
        try:
            self.open()
        except BaseException:
            self.close()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @abstractmethod
    def open(self) -> None:
        """Open it; SurroundingsError with cause and remedy where that cannot be done."""

    @abstractmethod
    def command(self, argv: Sequence[str], *, role: Role = "student") -> list[str]:
        """Return the command that runs `argv` inside, in its own PID, mount and IPC namespaces."""

    @abstractmethod
    def close(self) -> None:
        """End every process that was started in it and remove what it made."""

    @property
    @abstractmethod
    def workspace(self) -> str:
        """The workspace's path as commands inside see it."""

    @property
    def ros_path(self) -> str:
        """The ROS prefix's path as commands inside see it."""
        return self.ros.inside

    @abstractmethod
    def held(self) -> dict[str, str]:
        """Return what holds each limit here: cgroup, rlimit, tmpfs, grader or none."""

    def resource_met(self) -> str:
        """Return the limit on the whole submission that its processes ran into, "" if none."""
        return ""

    def limit_report(self) -> dict[str, LimitInfo]:
        """Return every limit with what holds it."""
        by = dict.fromkeys(UNITS, "grader") | self.held()
        return {
            name: LimitInfo(value=getattr(self.limits, name), unit=unit, held_by=by[name])
            for name, unit in UNITS.items()
        }

    def environment(self, role: Role) -> dict[str, str]:
        """Return the environment of a command inside: this list and nothing else."""
        base = {
            "HOME": HOME,
            "USER": "student",
            "LOGNAME": "student",
            "SHELL": "/bin/bash",
            "PATH": PATH,
            "LANG": "C.UTF-8",
            "TERM": "xterm-256color",
            "ROS_DOMAIN_ID": "0",
            "RMW_IMPLEMENTATION": "rmw_fastrtps_cpp",
            self._profile_variable: self.profile_path(role),
        }
        return base | self.extra_environment()

    @property
    def _profile_variable(self) -> str:
        """Fast DDS 3 (kilted on) has another name for it, and fails if both are set."""
        old = self.ros.distro.name in ("humble", "jazzy")
        return "FASTRTPS_DEFAULT_PROFILES_FILE" if old else "FASTDDS_DEFAULT_PROFILES_FILE"

    def extra_environment(self) -> dict[str, str]:
        """Return what this kind of sandbox adds to (or changes in) the list."""
        return {}

    @abstractmethod
    def profile_path(self, role: Role) -> str:
        """Return where the Fast DDS profile is, as a command of that role sees it."""

    def run(
        self,
        argv: Sequence[str],
        *,
        role: Role = "student",
        stdin: bytes = b"",
        seconds: float,
        output: float | None = None,
    ) -> Outcome:
        """Run a command to its end, both output streams together, cut while they are read.

        Ends it (and all that it started) at `seconds` of wall time or at `output` bytes.
        """
        most = int(self.limits.output if output is None else output)
        command = self.command(argv, role=role)
        started = time.monotonic()
        with subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            start_new_session=True,
            env=self.outer_environment(role),
        ) as process:
            try:
                text, stopped_by = _converse(process, stdin, started + seconds, most)
            finally:
                self.end(process)
        status = None if stopped_by else process.returncode
        return Outcome(status, text, time.monotonic() - started, stopped_by)

    def outer_environment(self, role: Role) -> Mapping[str, str]:
        """Return the environment for the command that `command` returned."""
        del role
        return {"PATH": PATH, "LANG": "C.UTF-8"}

    def end(self, process: subprocess.Popen[bytes]) -> None:
        """End a process that `command` made, and what it started, at once."""
        if process.poll() is None:
            kill_below(process.pid)
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(END_SECONDS)
        if process.poll() is None:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)


def kill_below(pid: int) -> None:
    """Kill the children of a process that `command` made, so that it collects them and ends.

    (Killed together with them it would leave an orphan behind, and a PID namespace does not end
    before somebody has collected the last of its processes.)
    """
    with contextlib.suppress(OSError):
        children = Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
        for child in children:
            os.kill(int(child), signal.SIGKILL)
        os.kill(pid, signal.SIGCONT if children else signal.SIGKILL)


def _converse(
    process: subprocess.Popen[bytes], stdin: bytes, deadline: float, most: int
) -> tuple[bytes, str]:
    """Feed stdin and read the output until the end of it; return it and which limit was met."""
    assert process.stdin is not None and process.stdout is not None
    output = bytearray()
    rest = memoryview(stdin)
    os.set_blocking(process.stdin.fileno(), False)
    with selectors.DefaultSelector() as selector:
        selector.register(process.stdout, selectors.EVENT_READ)
        if rest:
            selector.register(process.stdin, selectors.EVENT_WRITE)
        else:
            process.stdin.close()
        while True:
            left = deadline - time.monotonic()
            if left <= 0:
                return bytes(output), "wall time"
            for key, _ in selector.select(left):
                if key.fileobj is process.stdin:
                    try:
                        rest = rest[os.write(key.fd, rest[:65536]) :]
                    except BrokenPipeError:
                        rest = rest[:0]
                    if not rest:
                        selector.unregister(process.stdin)
                        process.stdin.close()
                    continue
                data = os.read(key.fd, 65536)
                if not data:
                    return _wait(process, deadline, output)
                output += data[: most - len(output)]
                if len(output) >= most:
                    return bytes(output), "output"


def _wait(
    process: subprocess.Popen[bytes], deadline: float, output: bytearray
) -> tuple[bytes, str]:
    try:
        process.wait(max(0.0, deadline - time.monotonic()))
    except subprocess.TimeoutExpired:
        return bytes(output), "wall time"
    return bytes(output), ""


def need(program: str, found: str | None) -> str:
    """Return the path of a program that a sandbox needs; SurroundingsError where it is missing."""
    if found is None:
        raise SurroundingsError(
            f"the program {program} is missing",
            remedy="Install it (Debian and Ubuntu: `sudo apt-get install bubblewrap util-linux "
            "coreutils`).",
        )
    return found
