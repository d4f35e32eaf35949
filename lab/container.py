"""The lab in Docker: one container for each workspace, distro and course, with any number of
terminals. It ends when the last terminal closes (`lab/supervisor.py`).
"""

from __future__ import annotations

import hashlib
import io
import os
import secrets
import sys
import tarfile
import time
from collections.abc import Iterator
from typing import Any
from urllib.parse import urlsplit

import docker
import requests
from docker.errors import APIError, DockerException, ImageNotFound, NotFound
from docker.models.containers import Container
from docker.models.images import Image
from docker.types import Mount

from grader.base.errors import SurroundingsError
from grader.base.i18n.message import say
from grader.sandbox.base import HOME
from lab.config import HIDDEN_HOME, LAB_ROOT, WORKSPACE, LabConfig, accounts
from lab.exec_stream import ExecStream
from lab.limits import LabLimits
from lab.supervisor import LAST, READY, VARIABLE
from lab.window.published import is_taken, published
from lab.workspace import Student

LABEL = "ros2-teaching-lab.lab"
SUPERVISOR = ["/usr/bin/python3", "-I", "-S", f"{LAB_ROOT}/lab/supervisor.py"]
IMAGE_USER = Student(1000, 1000)  # `student` in the images
SHARED_MEMORY = "256m"
LOCAL_HOSTS = ("localhost", "127.0.0.1", "::1")  # (the SDK also calls a Unix socket localhost)
OPEN_SECONDS = 30.0
END_SECONDS = 15.0
POLL_SECONDS = 0.05


class ContainerLab:
    """A lab in a container of a lab image."""

    def __init__(self, client: docker.DockerClient, image: Image) -> None:
        self._client = client
        self._image = image

    def enter(self, config: LabConfig) -> int:
        """Open a terminal in the lab's container and return the exit status of its command.

        Raises SurroundingsError if Docker cannot open it or the container is killed from outside.
        """
        try:
            _require_local_daemon(self._client)
            mark = secrets.token_hex(8)
            container, lease = self._open(config, mark)
            try:
                return self._run(container, config, mark)
            finally:
                _leave(container, lease)
        except (DockerException, requests.RequestException) as error:
            raise _failed(error) from error

    def _run(self, container: Container, config: LabConfig, mark: str) -> int:
        tty = sys.stdin.isatty() and sys.stdout.isatty()
        stream = ExecStream(
            self._client.api,
            str(container.id),
            config.words,
            tty=tty,
            user=_user(config),
            workdir=WORKSPACE,
            environment={**config.environment(os.environ), VARIABLE: mark},
        )
        try:
            return stream.run()
        finally:
            stream.close()

    def _open(self, config: LabConfig, mark: str) -> tuple[Container, ExecStream]:
        """Return the lab's container and a lease on it; start a new one if the old one ends."""
        deadline = time.monotonic() + OPEN_SECONDS
        while True:
            container = self._running(config) or self._start(config)
            lease = self._lease(container, config, mark) if container is not None else None
            if container is not None and lease is not None:
                return container, lease
            if time.monotonic() > deadline:
                raise SurroundingsError(
                    say("the lab's container does not start"), remedy=_remedy_for(config)
                )
            time.sleep(POLL_SECONDS)

    def _running(self, config: LabConfig) -> Container | None:
        try:
            found = self._client.containers.get(_name(config))
        except NotFound:
            return None
        return found if found.status == "running" else None

    def _start(self, config: LabConfig) -> Container | None:
        """Create and start the container; return None if it was too late for its name or port."""
        owner = config.workspace.owner
        try:
            made = self._client.containers.create(
                self._image,
                SUPERVISOR,
                entrypoint=[],
                name=_name(config),
                hostname=config.hostname,
                user=_user(config),
                # for `docker exec` and editors that attach; the terminals set theirs themselves
                working_dir=WORKSPACE,
                labels={LABEL: _hash(config)},
                init=True,
                auto_remove=True,
                cap_drop=["ALL"],
                security_opt=["no-new-privileges"],
                network_mode="bridge",
                **published(_environment(config)),
                **held(config.limits),
                mounts=list(_mounts(config)),
            )
        except APIError as error:
            if error.status_code == 409:  # the name is taken
                self._remove_stale(config)
                return None
            raise
        try:
            if owner != IMAGE_USER:
                made.put_archive("/etc", _packed_accounts(owner))
            made.start()
        except BaseException as error:
            _remove(made)
            if isinstance(error, APIError) and is_taken(error):
                return None
            raise
        return made

    def _remove_stale(self, config: LabConfig) -> None:
        """Remove an ended container of this lab that the daemon left behind when it was killed."""
        try:
            found = self._client.containers.get(_name(config))
        except NotFound:
            return
        if found.status in ("exited", "dead") and found.labels.get(LABEL) == _hash(config):
            _remove(found)

    def _lease(self, container: Container, config: LabConfig, mark: str) -> ExecStream | None:
        try:
            lease = ExecStream(
                self._client.api,
                str(container.id),
                [*SUPERVISOR, "lease", mark],
                user=_user(config),
                workdir="/",
            )
        except APIError:  # the container has ended meanwhile
            return None
        if lease.read_line(OPEN_SECONDS) == READY:
            return lease
        lease.close()
        return None


def _leave(container: Container, lease: ExecStream) -> None:
    """End the lease; if it was the last one, wait until the container is removed."""
    lease.end_input()
    last = lease.read_line(END_SECONDS) == LAST
    lease.close()
    deadline = time.monotonic() + END_SECONDS
    while last and time.monotonic() < deadline:
        try:
            container.reload()
        except NotFound:
            return
        time.sleep(POLL_SECONDS)  # (`wait` fails if the container is removed meanwhile)


def _remove(container: Container) -> None:
    try:
        container.remove(force=True)
    except APIError:
        return  # it is being removed


def _require_local_daemon(client: docker.DockerClient) -> None:
    """Raise SurroundingsError if the daemon cannot mount this machine's folders for the student."""
    address = str(client.api.base_url)
    options = client.info().get("SecurityOptions") or []
    if urlsplit(address).hostname not in LOCAL_HOSTS:
        raise SurroundingsError(
            say(
                "the Docker daemon is not on this machine ({address}), so it cannot mount the "
                "workspace",
                address=address,
            ),
            remedy=say("Unset DOCKER_HOST, or use SANDBOX=bubblewrap."),
        )
    if any("rootless" in str(option) for option in options):
        raise SurroundingsError(
            say("Docker runs rootless: files created in the lab would belong to another user id"),
            remedy=say("Use SANDBOX=bubblewrap."),
        )


def held(limits: LabLimits) -> dict[str, Any]:
    """Return the options of `containers.create` that hold the limits."""
    return {
        "pids_limit": limits.processes,
        "mem_limit": limits.memory,
        "memswap_limit": limits.memory,  # memory and swap together: no swap
        "shm_size": SHARED_MEMORY,
        "tmpfs": {
            "/tmp": f"exec,mode=1777,size={limits.tmp}",  # noqa: S108 - of the container
            # it is in the workspace too: without this, `find ~` would never end
            HIDDEN_HOME: "ro,size=4k,mode=0555",
        },
    }


def _user(config: LabConfig) -> str:
    return f"{config.workspace.owner.uid}:{config.workspace.owner.gid}"


def _mounts(config: LabConfig) -> Iterator[Mount]:
    yield Mount(HOME, str(config.workspace.home), type="bind")
    yield Mount(WORKSPACE, str(config.workspace.path), type="bind")
    if config.lesson.folder is not None:
        lesson = str(config.lesson.folder)
        yield Mount(config.lesson.path_inside, lesson, type="bind", read_only=True)


def _environment(config: LabConfig) -> dict[str, str]:
    """Return the variables of the container, with the caller's that decide which nodes are seen.

    The image's PATH has ROS and the lab's commands.
    """
    found = config.environment(os.environ)
    names = (config.own_environment.keys() - {"PATH"}) | {n for n in found if n.startswith("ROS_")}
    return {name: value for name, value in found.items() if name in names and name != "TERM"}


def _hash(config: LabConfig) -> str:
    """Return a hash of the mounts and the owner, which cannot change in a running container."""
    owner = config.workspace.owner
    text = f"{config.workspace.path}\0{owner.uid}\0{owner.gid}"
    if config.lesson.folder is not None:
        text += f"\0{config.lesson.folder}"
    return hashlib.sha256(os.fsencode(text)).hexdigest()[:16]


def _name(config: LabConfig) -> str:
    return f"ros2-teaching-lab-{config.distro.name}-{_hash(config)}"


def _packed_accounts(owner: Student) -> bytes:
    """Return a tar archive with passwd and group."""
    packed = io.BytesIO()
    with tarfile.open(fileobj=packed, mode="w") as archive:
        for name, text in accounts(owner).items():
            entry = tarfile.TarInfo(name)
            entry.size, entry.mode = len(text.encode()), 0o644
            archive.addfile(entry, io.BytesIO(text.encode()))
    return packed.getvalue()


def _failed(error: Any) -> SurroundingsError:
    if isinstance(error, ImageNotFound):
        return SurroundingsError(
            say("the lab's image was removed"), remedy=say("Build it again: make images")
        )
    said = error.explanation if isinstance(error, APIError) and error.explanation else str(error)
    return SurroundingsError(
        say("Docker could not run the lab: {problem}", problem=said),
        remedy=say("Check that the daemon is running (docker info), or use SANDBOX=bubblewrap."),
    )


def _remedy_for(config: LabConfig) -> str:
    return say(
        "Look at docker logs {name}, run docker rm -f {name}, and try again.", name=_name(config)
    )
