"""The interface of every sandbox: open it, start commands, end them all, close it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Literal

from grader.report.model import LimitInfo
from grader.ros.prefix import Ros
from grader.sandbox.limits import UNITS, Limits
from grader.sandbox.scheduling import RunClock, own_family

if TYPE_CHECKING:
    from typing_extensions import Self

Role = Literal["student", "probe"]
HOME = "/home/student"
WORKSPACE = f"{HOME}/ros2_ws"
PATH = "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"
LOAD = "load"
ROWS, COLUMNS = 40, 160  # of a pseudo-terminal
UNRUNNABLE = (126, 127)  # a shell's exit status for a program that it cannot run (POSIX sh, 2.8.2)

DISCOVERY_PROFILE = """<?xml version="1.0" encoding="UTF-8"?>
<profiles xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles">
  <transport_descriptors>
    <transport_descriptor>
      <transport_id>udp4</transport_id>
      <type>UDPv4</type>
    </transport_descriptor>
  </transport_descriptors>
  <participant profile_name="local" is_default_profile="true">
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
"""The Fast DDS profile of node and probe: only UDP, because shared memory does not cross
namespaces, and frequent announcements, because otherwise losing the first one costs 3 s."""


@dataclass(frozen=True)
class Outcome:
    """How a command ended; `status` is None if a limit ended it, `stopped_by` names that limit.

    It is LOAD if the time limit ended it, but the machine was too busy for that to mean anything.
    """

    status: int | None
    output: bytes
    seconds: float
    stopped_by: str = ""


class Console(ABC):
    """A command on its own pseudo-terminal."""

    @abstractmethod
    def wait(self, seconds: float) -> bool:
        """Wait for output; return whether there is any to read."""

    @abstractmethod
    def read(self) -> bytes:
        """Return the output so far, b"" after the last process has closed the terminal."""

    @abstractmethod
    def interrupt(self) -> None:
        """Send Ctrl+C. Raises OSError if the terminal is closed."""

    def type(self, keys: bytes) -> None:
        """Send what a person types. Raises OSError if the terminal is closed."""
        raise NotImplementedError

    def resize(self, rows: int, columns: int) -> None:
        """Tell the command the size of the person's terminal."""
        raise NotImplementedError

    @abstractmethod
    def poll(self) -> tuple[int | None, int | None] | None:
        """Return the command's exit status and signal, None while it runs."""

    @abstractmethod
    def end(self) -> None:
        """Kill what still runs on the terminal and close it."""

    def processes(self) -> set[int]:
        """Return the ids of its processes in this PID namespace; none if they are unknown."""
        return set()


class Pipe(ABC):
    """A command whose input and output are pipes."""

    @abstractmethod
    def write(self, data: bytes) -> None:
        """Write to its input. Raises OSError if the command no longer reads."""

    @abstractmethod
    def read(self, seconds: float) -> bytes | None:
        """Return its next output, b"" at the end, None if there was none within `seconds`."""

    @abstractmethod
    def errors(self) -> bytes:
        """Return its stderr after it has ended."""

    @abstractmethod
    def finish(self, seconds: float) -> None:
        """Close its input, wait up to `seconds` until it exits, kill it and close its pipes."""

    @abstractmethod
    def kill(self) -> None:
        """Kill it and everything that it started."""

    def processes(self) -> set[int]:
        """Return the ids of its processes in this PID namespace; none if they are unknown."""
        return set()


class Sandbox(ABC):
    """A sandbox with one workspace.

    Leaving the `with` block ends everything that was started in it.
    """

    name: str = ""

    def __init__(self, ros: Ros, limits: Limits) -> None:
        self.ros = ros
        self.limits = limits
        self.overlay = ""  # the shell's commands that take over the built workspace's environment

    @cached_property
    def run_clock(self) -> RunClock:
        """The time in which no process of the run waited for a core."""
        return RunClock(self.processes)

    def processes(self) -> set[int]:
        """Return the ids of all processes of the run in this PID namespace, as far as known."""
        return own_family()

    def __enter__(self) -> Self:
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
        """Open the sandbox; raise SurroundingsError with cause and remedy if that is impossible."""

    @abstractmethod
    def run(
        self,
        argv: Sequence[str],
        *,
        role: Role = "student",
        stdin: bytes = b"",
        seconds: float,
        output: float | None = None,
    ) -> Outcome:
        """Run a command and return its outcome, with stdout and stderr merged.

        The command and all that it started are killed after `seconds` of the run's clock or
        `output` bytes.
        """

    @abstractmethod
    def probe(self, argv: Sequence[str]) -> Pipe:
        """Start a probe with pipes, in a new network that has only loopback.

        No process of the student's has ever been in that network. (Sandboxes without namespaces
        have one network for everything.)
        """

    @abstractmethod
    def console(self, argv: Sequence[str], *, probe: Pipe | None = None) -> Console:
        """Start a command on a pseudo-terminal, as the student, in the network of `probe`."""

    @abstractmethod
    def close(self) -> None:
        """End every process in the sandbox and remove everything that it created."""

    @property
    def workspace(self) -> str:
        """The path of the workspace inside the sandbox."""
        return WORKSPACE

    @property
    def ros_path(self) -> str:
        """The path of the ROS prefix inside the sandbox."""
        return self.ros.inside

    def in_workspace(self, command: str) -> str:
        """Return a script of bash that runs a command in place of itself, with ROS and the overlay."""
        return f'. "{self.ros_path}/setup.bash"; {self.overlay}exec {command}'

    @abstractmethod
    def held_by(self) -> dict[str, str]:
        """Return what enforces each limit: cgroup, rlimit, tmpfs, grader or none."""

    def resource_limit_hit(self) -> str:
        """Return the limit on the whole submission that its processes hit, "" if none."""
        return ""

    def probe_limit_hit(self) -> str:
        """Return the limit that ended the probe, "" if none (a submission can send it too much)."""
        return ""

    def limit_report(self) -> dict[str, LimitInfo]:
        """Return every limit with what enforces it, and the total time limit computed from them."""
        held_by = dict.fromkeys(UNITS, "grader") | {"cpus": "none"} | self.held_by()
        ceiling = LimitInfo(value=self.limits.verdict_seconds, unit="s", held_by="grader")
        return {
            name: LimitInfo(value=getattr(self.limits, name), unit=unit, held_by=held_by[name])
            for name, unit in UNITS.items()
        } | {"verdict_seconds": ceiling}

    def environment(self, role: Role) -> dict[str, str]:
        """Return the complete environment of a command in the sandbox."""
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
            self.ros.distro.dds_profile: self.profile_path(role),
        }
        return base | self.extra_environment()

    def extra_environment(self) -> dict[str, str]:
        """Return the variables that this kind of sandbox adds or overrides."""
        return {}

    @abstractmethod
    def profile_path(self, role: Role) -> str:
        """Return the path of the Fast DDS profile inside the sandbox, for a command of a role."""
