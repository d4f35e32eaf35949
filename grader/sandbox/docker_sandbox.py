"""The `docker` sandbox: containers without network, capabilities or a writable system.

A holder container owns the workspace (a volume in memory); the first probe runs in it. The
student's build and each run get their own container, with its own PID, mount and IPC namespaces and
another user. The build has a network of its own, and so has each probe: a run shares its
probe's. Files are copied in as a tar stream; no folder of this machine is mounted. `container`
explains how a container ends with the grader.
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
from grader.sandbox.container import PROBE, PROFILE, STUDENT, Container, ContainerSpec
from grader.sandbox.execs import (
    STATUS_SECONDS,
    End,
    ExecConsole,
    ExecPipe,
    communicate,
    docker_errors,
)
from grader.sandbox.limits import Limits
from grader.sandbox.scheduling import STRETCH

if TYPE_CHECKING:
    from docker import DockerClient
    from docker.models.images import Image

Slot = Literal["build", "run"]
USERS: dict[Role, int] = {"student": STUDENT, "probe": PROBE}
SPARE_SECONDS = 120.0  # a container's lifetime beyond the most wall time of the verdict


class DockerSandbox(Sandbox):
    """Commands in Docker containers, through the Docker SDK."""

    name = "docker"

    def __init__(self, client: DockerClient, image: Image, distro: Distro, limits: Limits) -> None:
        label = image.labels.get(images.ROS_LABEL, "image")
        with docker_errors("inspecting the image"):
            versions = images.image_versions(client, image) | {
                "image": f"{image.tags[0] if image.tags else ''}@{image.id}"
            }
        inside = Path("/opt/ros") / distro.name
        super().__init__(Ros(distro, label, inside, Path("/usr/bin/python3"), versions), limits)
        self._client = client
        self._image = str(image.id)
        self._threads = ThreadPoolExecutor(max_workers=4, thread_name_prefix="docker")
        self._holder: Container | None = None
        self._probe: Container | None = None
        self._slots: dict[Slot, Future[Container]] = {}
        self._has_had_a_probe = False
        self._removals: list[Future[None]] = []
        self._limit_hit = ""

    def profile_path(self, role: Role) -> str:
        del role
        return PROFILE

    def held_by(self) -> dict[str, str]:
        by = {"cpu_seconds": "rlimit", "file_size": "rlimit", "workspace": "tmpfs"}
        return by | dict.fromkeys(("memory", "processes", "cpus"), "cgroup")

    def open(self) -> None:
        with docker_errors("opening the sandbox"):
            orphans.remove_orphans(self._client)
            self._holder = self._probe = Container(self._client.api, self._spec())
        self._prepare("build")

    def processes(self) -> set[int]:
        ready = [one for one in self._slots.values() if one.done() and not one.exception()]
        made = [future.result() for future in ready]
        known = [one for one in (self._holder, self._probe, *made) if one is not None]
        return super().processes().union(*(one.processes() for one in known))

    def _spec(self) -> ContainerSpec:
        """Return the settings of the holder, in which the first probe runs."""
        limits = self.limits
        lifetime = STRETCH * limits.verdict_seconds + SPARE_SECONDS
        options = f"size={int(limits.workspace)},uid={STUDENT},gid={STUDENT},mode=0700,nosuid,nodev"
        driver = {"type": "tmpfs", "device": "tmpfs", "o": options}
        volume = {"NoCopy": True, "DriverConfig": {"Name": "local", "Options": driver}}
        labels = orphans.labels(lifetime)
        return ContainerSpec(
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

    def _prepare(self, slot: Slot) -> Future[Container]:
        """Start to create a container in the background; for a run, in the probe's network."""
        spec = replace(
            self._spec(),
            user=STUDENT,
            network=f"container:{self._open_probe.id}" if slot == "run" else "none",
            mounts=(),
            volumes_from=(self._open_holder.id,),
        )
        # the SDK's client is not thread-safe: each container has its own
        future = self._threads.submit(lambda: Container(images.connect().api, spec))
        self._slots[slot] = future
        return future

    def _container(self, slot: Slot) -> Future[Container]:
        return self._slots.get(slot) or self._prepare(slot)

    def _retire(self, slot: Slot, container: Future[Container]) -> None:
        """Remove a container in the background."""
        if self._slots.get(slot) is container:
            del self._slots[slot]
            self._removals.append(self._threads.submit(_remove, container))

    def _inside(self, argv: Sequence[str], role: Role) -> list[str]:
        """Return the command line that sets environment, folder and limits for `argv`."""
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
        max_output = int(self.limits.output if output is None else output)
        if role == "probe":
            with docker_errors("running a command in the probe's container"):
                return self._communicate(self._open_holder, argv, role, stdin, seconds, max_output)
        future = self._container("build")
        with docker_errors("running a command in a container"):
            container = future.result()
            try:
                outcome = self._communicate(container, argv, role, stdin, seconds, max_output)
            except docker.errors.APIError:
                # the submission has filled or ended a container that accepts no commands
                outcome = Outcome(None, b"", 0.0, "resources")
            if outcome.status != 0:
                self._limit_hit = container.limit_hit()
            if outcome.stopped_by or not container.is_quiet():
                self._retire("build", future)
                self._removals[-1].result()  # no command may see anything of the one before
        return outcome

    def _communicate(
        self,
        container: Container,
        argv: Sequence[str],
        role: Role,
        stdin: bytes,
        seconds: float,
        max_output: int,
    ) -> Outcome:
        command = container.start(self._inside(argv, role), user=USERS[role])
        if "run" not in self._slots:
            self._prepare("run")
        try:
            limit = self.run_clock.limit(seconds)
            return communicate(command, stdin, limit=limit, max_output=max_output)
        finally:
            command.close()

    def console(self, argv: Sequence[str], *, probe: Pipe | None = None) -> Console:
        # a separate container: nothing that a build leaves behind is there when the node runs
        del probe  # the latest one: its network is that of the prepared container
        future = self._container("run")
        with docker_errors("starting the node"):
            inside = self._inside(argv, "student")
            command = future.result().start(inside, user=STUDENT, tty=True)
        return ExecConsole(command, ended=partial(self._console_ended, future))

    def _console_ended(self, future: Future[Container], how: End) -> None:
        if how != "interrupted":
            with docker_errors("reading which limit was hit"):
                self._limit_hit = future.result().limit_hit()
        self._retire("run", future)

    def probe(self, argv: Sequence[str]) -> Pipe:
        with docker_errors("starting the probe"):
            if self._has_had_a_probe:
                self._renew_network()
            self._has_had_a_probe = True
            container = self._open_probe
            command = container.start(self._inside(argv, "probe"), user=PROBE)
        return ExecPipe(command, ended=partial(_end_probe, container))

    def _renew_network(self) -> None:
        """Replace the probe's container and network; the run's container was for the old one."""
        run, former = self._slots.get("run"), self._open_probe
        if run is not None:
            self._retire("run", run)
        spec = replace(self._spec(), mounts=())
        self._probe = Container(self._client.api, spec)
        if former is not self._holder:
            self._removals.append(self._threads.submit(former.remove))

    @property
    def _open_holder(self) -> Container:
        if self._holder is None:
            raise SurroundingsError("the sandbox is closed")
        return self._holder

    @property
    def _open_probe(self) -> Container:
        if self._probe is None:
            raise SurroundingsError("the sandbox is closed")
        return self._probe

    def resource_limit_hit(self) -> str:
        hit, self._limit_hit = self._limit_hit, ""
        return hit

    def probe_limit_hit(self) -> str:
        with docker_errors("reading what ended the probe"):
            return self._open_probe.limit_hit()

    def close(self) -> None:
        for slot, container in list(self._slots.items()):
            self._retire(slot, container)
        own = dict.fromkeys((self._probe, self._holder))  # (the first probe's is the holder)
        self._probe = self._holder = None
        try:
            with docker_errors("closing the sandbox"):
                for opened in own:
                    if opened is not None:
                        opened.remove()
                for removal in self._removals:
                    removal.result()
        finally:
            self._threads.shutdown()
            self._client.close()


def _end_probe(container: Container) -> None:
    """Kill every process of the probe's user; only the probe runs as that user."""
    with docker_errors("ending the probe"):
        killer = container.start(["sh", "-c", "kill -KILL -1"], user=PROBE)
        killer.wait(STATUS_SECONDS)
        killer.close()


def _remove(container: Future[Container]) -> None:
    try:
        made = container.result()
    except Exception:  # it was never created: the caller has received the error
        return
    made.remove()
