"""The `docker` sandbox: containers without network, rights or a writable system.

A holder owns a network of loopback alone and the workspace (a volume in memory), and the probe runs
in it. The student's build and run each get a container of their own beside it, with PID, mount and
IPC namespaces and as another user. Files go in as a tar stream; nothing of this machine is
mounted. See `cells` for how a container ends with the grader.
"""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import docker.errors

from grader.base.errors import SurroundingsError
from grader.ros import images
from grader.ros.distro import Distro
from grader.ros.prefix import Ros
from grader.sandbox import orphans
from grader.sandbox.base import DISCOVERY_PROFILE, WORKSPACE, Console, Outcome, Pipe, Role, Sandbox
from grader.sandbox.cells import PROBE, PROFILE, STUDENT, Cell, Plan
from grader.sandbox.execs import STATUS_SECONDS, End, ExecConsole, ExecPipe, converse, docker_errors
from grader.sandbox.limits import Limits

if TYPE_CHECKING:
    from docker import DockerClient
    from docker.models.images import Image

Slot = Literal["build", "run"]
USERS: dict[Role, int] = {"student": STUDENT, "probe": PROBE}
SPARE_SECONDS = 120.0  # of a container's life beyond the ceiling of the verdict


class Containers(Sandbox):
    """Commands in containers of the Docker daemon, by the Docker SDK."""

    name = "docker"

    def __init__(self, client: DockerClient, image: Image, distro: Distro, limits: Limits) -> None:
        label = image.labels.get(images.ROS_LABEL, "image")
        with docker_errors("looking at the image"):
            versions = images.image_versions(client, image) | {
                "image": f"{image.tags[0] if image.tags else ''}@{image.id}"
            }
        inside = Path("/opt/ros") / distro.name
        super().__init__(Ros(distro, label, inside, Path("/usr/bin/python3"), versions), limits)
        self._client = client
        self._image = str(image.id)
        self._threads = ThreadPoolExecutor(max_workers=4, thread_name_prefix="docker")
        self._holder: Cell | None = None
        self._slots: dict[Slot, Future[Cell]] = {}
        self._removals: list[Future[None]] = []
        self._met = ""

    def profile_path(self, role: Role) -> str:
        del role
        return PROFILE

    def held(self) -> dict[str, str]:
        by = {"cpu_seconds": "rlimit", "file_size": "rlimit", "workspace": "tmpfs"}
        return by | dict.fromkeys(("memory", "processes", "cpus"), "cgroup")

    def open(self) -> None:
        with docker_errors("opening the sandbox"):
            orphans.clear_away(self._client)
            self._holder = Cell(self._client.api, self._plan())
        self._prepare("build")

    def _plan(self) -> Plan:
        """Return the plan of the holder, in which the probe runs."""
        limits = self.limits
        lifetime = limits.verdict_seconds + SPARE_SECONDS
        options = f"size={int(limits.workspace)},uid={STUDENT},gid={STUDENT},mode=0700,nosuid,nodev"
        driver = {"type": "tmpfs", "device": "tmpfs", "o": options}
        volume = {"NoCopy": True, "DriverConfig": {"Name": "local", "Options": driver}}
        labels = orphans.labels(lifetime)
        return Plan(
            image=self._image,
            limits=limits,
            labels=labels,
            lifetime=lifetime,
            profile=DISCOVERY_PROFILE,
            cpus=min(limits.cpus, float(self._client.info()["NCPU"])),
            user=PROBE,
            mounts=(
                {
                    "Type": "volume",
                    "Target": WORKSPACE,
                    "VolumeOptions": {**volume, "Labels": labels},
                },
            ),
        )

    def _prepare(self, slot: Slot) -> Future[Cell]:
        """Start to make a cell, beside what else is going on."""
        holder = self._open_holder.id
        plan = replace(
            self._plan(),
            user=STUDENT,
            network=f"container:{holder}",
            mounts=(),
            volumes_from=(holder,),
        )
        # the SDK's client is not for several threads at once: each cell has its own
        made = self._threads.submit(lambda: Cell(images.connect().api, plan))
        self._slots[slot] = made
        return made

    def _cell(self, slot: Slot) -> Future[Cell]:
        return self._slots.get(slot) or self._prepare(slot)

    def _retire(self, slot: Slot, cell: Future[Cell]) -> None:
        """Remove a cell beside what else is going on."""
        if self._slots.get(slot) is cell:
            del self._slots[slot]
            self._removals.append(self._threads.submit(_remove, cell))

    def _inside(self, argv: Sequence[str], role: Role) -> list[str]:
        """Return the command with its environment, its folder and its limits."""
        values = [f"{name}={value}" for name, value in self.environment(role).items()]
        limits = self.limits
        words = ["env", "-i", "-C", WORKSPACE if role == "student" else "/", *values]
        words += ["prlimit", "--core=0", f"--fsize={int(limits.file_size)}"]
        if role == "student":
            words.append(f"--cpu={int(limits.cpu_seconds)}")
        return [*words, "--", *argv]

    def run(
        self,
        argv: Sequence[str],
        *,
        role: Role = "student",
        stdin: bytes = b"",
        seconds: float,
        output: float | None = None,
    ) -> Outcome:
        most = int(self.limits.output if output is None else output)
        if role == "probe":
            with docker_errors("running a command beside the probe"):
                return self._converse(self._open_holder, argv, role, stdin, seconds, most)
        future = self._cell("build")
        with docker_errors("running a command in a container"):
            cell = future.result()
            try:
                outcome = self._converse(cell, argv, role, stdin, seconds, most)
            except docker.errors.APIError:
                # a container that takes no command any more was filled or ended by what is in it
                outcome = Outcome(None, b"", 0.0, "resources")
            if outcome.status != 0:
                self._met = cell.met()
            if outcome.stopped_by or not cell.is_quiet():
                self._retire("build", future)
                self._removals[-1].result()  # nothing of one command is seen by the next
        return outcome

    def _converse(
        self,
        cell: Cell,
        argv: Sequence[str],
        role: Role,
        stdin: bytes,
        seconds: float,
        most: int,
    ) -> Outcome:
        command = cell.start(self._inside(argv, role), user=USERS[role])
        if "run" not in self._slots:
            self._prepare("run")
        try:
            return converse(command, stdin, seconds=seconds, most=most)
        finally:
            command.close()

    def console(self, argv: Sequence[str]) -> Console:
        # a cell of its own: nothing that a build leaves behind is there when the node runs
        future = self._cell("run")
        with docker_errors("starting the node"):
            inside = self._inside(argv, "student")
            command = future.result().start(inside, user=STUDENT, tty=True)
        return ExecConsole(command, ended=partial(self._console_ended, future))

    def _console_ended(self, future: Future[Cell], how: End) -> None:
        if how != "as asked":
            with docker_errors("looking at what met a limit"):
                self._met = future.result().met()
        self._retire("run", future)

    def pipe(self, argv: Sequence[str], *, role: Role) -> Pipe:
        with docker_errors("starting the probe"):
            if role == "probe":
                command = self._open_holder.start(self._inside(argv, role), user=PROBE)
                return ExecPipe(command, ended=self._end_probe)
            future = self._cell("run")
            command = future.result().start(self._inside(argv, role), user=STUDENT)
            return ExecPipe(command, ended=partial(self._retire, "run", future))

    @property
    def _open_holder(self) -> Cell:
        if self._holder is None:
            raise SurroundingsError("the sandbox is closed")
        return self._holder

    def _end_probe(self) -> None:
        """End every process of the probe's user: nobody else is that user there."""
        with docker_errors("ending the probe"):
            killer = self._open_holder.start(["sh", "-c", "kill -KILL -1"], user=PROBE)
            killer.wait(STATUS_SECONDS)
            killer.close()

    def resource_met(self) -> str:
        met, self._met = self._met, ""
        return met

    def probe_met(self) -> str:
        with docker_errors("looking at what ended the probe"):
            return self._open_holder.met()

    def close(self) -> None:
        for slot, cell in list(self._slots.items()):
            self._retire(slot, cell)
        holder, self._holder = self._holder, None
        try:
            with docker_errors("closing the sandbox"):
                if holder is not None:
                    holder.remove()
                for removal in self._removals:
                    removal.result()
        finally:
            self._threads.shutdown()
            self._client.close()


def _remove(cell: Future[Cell]) -> None:
    try:
        made = cell.result()
    except Exception:  # it was never made: whoever asked for it has been told
        return
    made.remove()
