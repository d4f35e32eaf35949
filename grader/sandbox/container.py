"""A locked-down Docker container that ends when the grader ends.

Its main process runs as a user of its own and reads a stream from the grader. However the grader
ends, the stream closes, the main process exits, the container stops and the daemon removes it. A
time limit ends the container even if the closing of the stream is lost.
"""

from __future__ import annotations

import contextlib
import select
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import docker.errors
from docker.types import LogConfig

from grader.base.errors import SurroundingsError
from grader.sandbox.base import HOME
from grader.sandbox.execs import Exec, Frames, communicate, socket_of
from grader.sandbox.limits import Limits
from grader.sandbox.processes import stat_fields
from grader.sandbox.scheduling import RunClock, family
from grader.sandbox.seccomp import docker_profile

if TYPE_CHECKING:
    from docker import APIClient

STUDENT, PROBE, HOLDER = 1000, 1001, 1002  # user ids in the images
PROFILE = "/run/ros/fastdds.xml"
READY_SECONDS = 30.0
MAX_COUNTERS = 100_000  # bytes of the kernel's counters
OWN_PROCESSES = 3  # docker-init, timeout, cat
MAIN_SCRIPT = (
    f'umask 022; printf %s "$1" > {PROFILE}; echo ready; '
    'exec timeout --signal=KILL "$2" cat > /dev/null'
)
# the kernel's counters of limits that were hit: control groups version 1, then version 2
COUNTERS_SCRIPT = (
    "cat /sys/fs/cgroup/memory/memory.oom_control /sys/fs/cgroup/memory.events 2>/dev/null; "
    "sed s/^max/pids_max/ /sys/fs/cgroup/pids/pids.events /sys/fs/cgroup/pids.events 2>/dev/null; :"
)


@dataclass(frozen=True)
class ContainerSpec:
    """The settings of a container.

    `user` runs the commands in it; `network` is "none" or "container:ID" (whose network is shared).
    """

    image: str
    limits: Limits
    labels: Mapping[str, str]
    lifetime: float
    profile: str
    cpus: float
    user: int = STUDENT
    network: str = "none"
    volumes_from: tuple[str, ...] = ()
    mounts: tuple[Mapping[str, Any], ...] = field(default=())

    def host_config(self, api: APIClient) -> dict[str, Any]:
        """Return the container's HostConfig of the Docker API."""
        limits = self.limits
        scratch = int(limits.workspace / 10)
        config: dict[str, Any] = api.create_host_config(
            auto_remove=True,
            cap_drop=["ALL"],
            init=True,
            ipc_mode="private",
            mem_limit=int(limits.memory),
            memswap_limit=int(limits.memory),
            nano_cpus=int(self.cpus * 1_000_000_000),
            network_mode=self.network,
            pids_limit=int(limits.processes),
            read_only=True,
            security_opt=["no-new-privileges", f"seccomp={docker_profile()}"],
            shm_size=scratch,
            tmpfs={
                "/run/ros": f"size=65536,mode=0755,uid={HOLDER},gid={HOLDER},noexec",
                "/tmp": f"size={scratch},mode=1777,exec",  # noqa: S108
                HOME: f"size={scratch},mode=0755,uid={self.user},gid={self.user},exec",
            },
            volumes_from=list(self.volumes_from) or None,
            log_config=LogConfig(type="none"),
        )
        config["Mounts"] = list(self.mounts)
        return config


class Container:
    """A container in which commands are started. Raises what the Docker SDK raises."""

    def __init__(self, api: APIClient, spec: ContainerSpec) -> None:
        self._api = api
        made = api.create_container(
            spec.image,
            ["sh", "-c", MAIN_SCRIPT, "holder", spec.profile, str(int(spec.lifetime))],
            entrypoint=[],
            stdin_open=True,
            user=f"{HOLDER}:{HOLDER}",
            working_dir="/",
            hostname="lab" if spec.network == "none" else None,
            labels=dict(spec.labels),
            environment={},
            host_config=spec.host_config(api),
        )
        self.id: str = made["Id"]
        try:
            # its input closes with this socket (StdinOnce), so it ends when the grader does
            self._line = api.attach_socket(
                self.id, params={"stdin": 1, "stdout": 1, "stderr": 1, "stream": 1}
            )
            api.start(self.id)
            self._wait_until_ready()
        except BaseException:
            self.remove()
            raise

    def _wait_until_ready(self) -> None:
        line = socket_of(self._line)
        frames, said = Frames(), b""
        limit = RunClock().limit(READY_SECONDS)
        while b"ready\n" not in said:
            if not select.select([line], [], [], limit.slice)[0] and not limit.over:
                continue
            data = b"" if limit.over else line.recv(4096)
            if not data:
                text = said.decode(errors="replace").strip() or "nothing"
                raise SurroundingsError(f"the container did not start; its output: {text}")
            said += b"".join(text for _, text in frames.feed(data))

    def start(self, argv: Sequence[str], *, user: int, tty: bool = False) -> Exec:
        """Start a command in the container."""
        return Exec(self._api, self.id, argv, user=user, tty=tty)

    def processes(self) -> set[int]:
        """Return the ids of its processes if this machine runs the daemon, else none."""
        return family(self._root) if self._root else set()

    @cached_property
    def _root(self) -> int:
        """The process that started its main process and its commands, 0 if that is elsewhere."""
        with contextlib.suppress(docker.errors.APIError, OSError):
            pid = int(self._api.inspect_container(self.id)["State"].get("Pid") or 0)
            groups = Path(f"/proc/{pid}/cgroup").read_text(encoding="utf-8") if pid else ""
            if self.id in groups:
                return int(stat_fields(pid)[1])
        return 0

    def is_quiet(self) -> bool:
        """Whether only the main process runs in it."""
        try:
            return len(self._api.top(self.id)["Processes"] or ()) <= OWN_PROCESSES
        except docker.errors.APIError:
            return False

    def limit_hit(self) -> str:
        """Return the limit that its processes hit: "memory", "processes" or ""."""
        try:
            query = Exec(self._api, self.id, ["sh", "-c", COUNTERS_SCRIPT], user=HOLDER)
        except docker.errors.NotFound:
            return "memory"  # only the kernel's out-of-memory killer ends the main process early
        except docker.errors.APIError:
            return "processes"  # not even this command could be started
        limit = RunClock().limit(READY_SECONDS)
        outcome = communicate(query, b"", limit=limit, max_output=MAX_COUNTERS)
        query.close()
        words = outcome.output.decode(errors="replace").split()
        counts = {a: int(b) for a, b in zip(words, words[1:]) if b.isdigit()}
        if counts.get("oom_kill", 0):
            return "memory"
        return "processes" if counts.get("pids_max", 0) or outcome.status != 0 else ""

    def remove(self) -> None:
        """Kill the container and wait until it and its volume are removed."""
        with contextlib.suppress(docker.errors.NotFound):
            try:
                self._api.remove_container(self.id, force=True, v=True)
            except docker.errors.APIError as error:
                if error.status_code != 409:  # the removal has already started
                    raise
                with contextlib.suppress(docker.errors.NotFound):
                    self._api.wait(self.id, condition="removed")
        line = getattr(self, "_line", None)
        if line is not None:
            line.close()
