"""A cell: one locked-down container, kept by a process that ends when the grader does.

Its first process is a keeper of another user than what runs in the cell. It reads a stream from
the grader: whichever way the grader ends, the stream closes, the keeper ends, the container with
it, and the daemon removes it. A time limit of its own ends it where even the stream is lost.
"""

from __future__ import annotations

import contextlib
import select
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import docker.errors
from docker.types import LogConfig

from grader.base.errors import SurroundingsError
from grader.sandbox.base import HOME
from grader.sandbox.execs import Exec, Frames, converse, socket_of
from grader.sandbox.limits import Limits

if TYPE_CHECKING:
    from docker import APIClient

STUDENT, PROBE, KEEPER = 1000, 1001, 1002
PROFILE = "/run/grader/fastdds.xml"
READY_SECONDS = 30.0
MOST_SAID = 100_000  # bytes of what the kernel says of a cell
KEEPER_PROCESSES = 3  # docker-init, timeout, cat
KEEP = (
    f'umask 022; printf %s "$1" > {PROFILE}; echo ready; '
    'exec timeout --signal=KILL "$2" cat > /dev/null'
)
# the kernel's own words on what met a limit: version 1 of control groups, then version 2
MET = (
    "cat /sys/fs/cgroup/memory/memory.oom_control /sys/fs/cgroup/memory.events 2>/dev/null; "
    "sed s/^max/pids_max/ /sys/fs/cgroup/pids/pids.events /sys/fs/cgroup/pids.events 2>/dev/null; :"
)


@dataclass(frozen=True)
class Plan:
    """What a cell is made of. `user` is whose commands will run in it.

    `network`: none, or the container to share one with.
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
        """Return the container's constraints in the API's words."""
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
            security_opt=["no-new-privileges"],
            shm_size=scratch,
            tmpfs={
                "/run/grader": f"size=65536,mode=0755,uid={KEEPER},gid={KEEPER},noexec",
                "/tmp": f"size={scratch},mode=1777,exec",  # noqa: S108
                HOME: f"size={scratch},mode=0755,uid={self.user},gid={self.user},exec",
            },
            volumes_from=list(self.volumes_from) or None,
            log_config=LogConfig(type="none"),
        )
        config["Mounts"] = list(self.mounts)
        return config


class Cell:
    """One container that commands are started in. Raises what the Docker SDK raises."""

    def __init__(self, api: APIClient, plan: Plan) -> None:
        self._api = api
        made = api.create_container(
            plan.image,
            ["sh", "-c", KEEP, "keeper", plan.profile, str(int(plan.lifetime))],
            entrypoint=[],
            stdin_open=True,
            user=f"{KEEPER}:{KEEPER}",
            working_dir="/",
            hostname="lab" if plan.network == "none" else None,
            labels=dict(plan.labels),
            environment={},
            host_config=plan.host_config(api),
        )
        self.id: str = made["Id"]
        try:
            # its input closes when this socket does (StdinOnce): that is how it hears of our end
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
        deadline = time.monotonic() + READY_SECONDS
        while b"ready\n" not in said:
            left = max(0.0, deadline - time.monotonic())
            data = line.recv(4096) if select.select([line], [], [], left)[0] else b""
            if not data:
                text = said.decode(errors="replace").strip() or "nothing"
                raise SurroundingsError(f"the container did not start; it said: {text}")
            said += b"".join(text for _, text in frames.feed(data))

    def start(self, argv: Sequence[str], *, user: int, tty: bool = False) -> Exec:
        """Start a command in it."""
        return Exec(self._api, self.id, argv, user=user, tty=tty)

    def is_quiet(self) -> bool:
        """Whether nothing but the keeper runs in it."""
        try:
            return len(self._api.top(self.id)["Processes"] or ()) <= KEEPER_PROCESSES
        except docker.errors.APIError:
            return False

    def met(self) -> str:
        """Return the limit that its processes ran into: "memory", "processes" or ""."""
        try:
            asked = Exec(self._api, self.id, ["sh", "-c", MET], user=KEEPER)
        except docker.errors.NotFound:
            return "memory"  # nothing but the kernel's lack of memory ends a keeper before its time
        except docker.errors.APIError:
            return "processes"  # not even this one was let in
        outcome = converse(asked, b"", seconds=READY_SECONDS, most=MOST_SAID)
        asked.close()
        words = outcome.output.decode(errors="replace").split()
        counts = {a: int(b) for a, b in zip(words, words[1:]) if b.isdigit()}
        if counts.get("oom_kill", 0):
            return "memory"
        return "processes" if counts.get("pids_max", 0) or outcome.status != 0 else ""

    def remove(self) -> None:
        """Kill it and wait until it is gone, with the volume that only it used."""
        with contextlib.suppress(docker.errors.NotFound):
            try:
                self._api.remove_container(self.id, force=True, v=True)
            except docker.errors.APIError as error:
                if error.status_code != 409:  # its removal has begun already
                    raise
                with contextlib.suppress(docker.errors.NotFound):
                    self._api.wait(self.id, condition="removed")
        line = getattr(self, "_line", None)
        if line is not None:
            line.close()
