"""The small interface that every sandbox offers: open it, start commands, stop them all, close."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from grader.report.model import LimitInfo
from grader.ros.prefix import Ros
from grader.sandbox.limits import UNITS, Limits

if TYPE_CHECKING:
    from typing_extensions import Self

Role = Literal["student", "probe"]
HOME = "/home/student"
WORKSPACE = f"{HOME}/ros2_ws"
PATH = "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"
ROWS, COLUMNS = 40, 160  # of a pseudo-terminal
UNRUNNABLE = (126, 127)  # a shell's status for a program that it cannot run (POSIX, sh: 2.8.2)

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


class Console(ABC):
    """A command on a pseudo-terminal of its own."""

    @abstractmethod
    def wait(self, seconds: float) -> bool:
        """Wait until something has come; return whether it has."""

    @abstractmethod
    def read(self) -> bytes:
        """Return what has come, b"" once the last process has let go of the terminal."""

    @abstractmethod
    def interrupt(self) -> None:
        """Press Ctrl+C. Raises OSError where nobody is there any more."""

    @abstractmethod
    def poll(self) -> tuple[int | None, int | None] | None:
        """Return exit status and signal of the command, None while it runs."""

    @abstractmethod
    def end(self) -> None:
        """End what still runs on it, and let go of it."""


class Pipe(ABC):
    """A command whose input and output are pipes."""

    @abstractmethod
    def write(self, data: bytes) -> None:
        """Write to its input. Raises OSError where nobody reads any more."""

    @abstractmethod
    def read(self, seconds: float) -> bytes | None:
        """Return what has come on its output, b"" at its end, None if nothing came in time."""

    @abstractmethod
    def errors(self) -> bytes:
        """Return what it said on stderr, once it has ended."""

    @abstractmethod
    def finish(self, seconds: float) -> None:
        """Close its input, give it that long to end by itself, then end it and let go of it."""

    @abstractmethod
    def kill(self) -> None:
        """End it, and what it started, at once."""


class Sandbox(ABC):
    """A sandbox over one workspace.

    Leaving the `with` block ends everything that was started in it.
    """

    name: str = ""

    def __init__(self, ros: Ros, limits: Limits) -> None:
        self.ros = ros
        self.limits = limits

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
        """Open it; SurroundingsError with cause and remedy where that cannot be done."""

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
        """Run a command to its end, both output streams together, cut while they are read.

        Ends it (and all that it started) at `seconds` of wall time or at `output` bytes.
        """

    @abstractmethod
    def console(self, argv: Sequence[str]) -> Console:
        """Start a command of the student's on a pseudo-terminal."""

    @abstractmethod
    def pipe(self, argv: Sequence[str], *, role: Role) -> Pipe:
        """Start a command with pipes."""

    @abstractmethod
    def close(self) -> None:
        """End every process that was started in it and remove what it made."""

    @property
    def workspace(self) -> str:
        """The workspace's path as commands inside see it."""
        return WORKSPACE

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

    def probe_met(self) -> str:
        """Return the limit that ended the probe, "" if none: the submission has fed it too much."""
        return ""

    def limit_report(self) -> dict[str, LimitInfo]:
        """Return every limit with what holds it, and the ceiling that follows from them."""
        by = dict.fromkeys(UNITS, "grader") | {"cpus": "none"} | self.held()
        ceiling = LimitInfo(value=self.limits.verdict_seconds, unit="s", held_by="grader")
        return {
            name: LimitInfo(value=getattr(self.limits, name), unit=unit, held_by=by[name])
            for name, unit in UNITS.items()
        } | {"verdict_seconds": ceiling}

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
            self.ros.distro.dds_profile: self.profile_path(role),
        }
        return base | self.extra_environment()

    def extra_environment(self) -> dict[str, str]:
        """Return what this kind of sandbox adds to (or changes in) the list."""
        return {}

    @abstractmethod
    def profile_path(self, role: Role) -> str:
        """Return where the Fast DDS profile is, as a command of that role sees it."""
