"""The lab in a Docker container: one container for one workspace, distro and course, and as many
terminals in it as are opened. It ends with the last of them (`lab/keeper.py`).
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
from lab.exec_stream import ExecStream
from lab.keeper import LAST, READY, VARIABLE
from lab.visit import ROOM, WORKSPACE, Visit, accounts
from lab.workspace import Student

LABEL = "ros2-teaching-lab.lab"
KEEPER = ["/usr/bin/python3", "-I", "-S", f"{ROOM}/lab/keeper.py"]
IMAGE_USER = Student(1000, 1000)  # `student` of the images
SHARED_MEMORY = "256m"
HERE = ("localhost", "127.0.0.1", "::1")  # (the SDK calls a Unix socket localhost, too)
OPEN_SECONDS = 30.0
END_SECONDS = 15.0
POLL_SECONDS = 0.05


class ContainerLab:
    """The lab as a container of an image's."""

    def __init__(self, client: docker.DockerClient, image: Image) -> None:
        self._client = client
        self._image = image

    def enter(self, visit: Visit) -> int:
        """Open a terminal in the workspace's lab and return the exit status of what ran in it.

        Raises SurroundingsError where Docker cannot do it, or ends it from outside.
        """
        try:
            _must_be_here(self._client)
            mark = secrets.token_hex(8)
            container, lease = self._open(visit, mark)
            try:
                return self._run(container, visit, mark)
            finally:
                _leave(container, lease)
        except (DockerException, requests.RequestException) as error:
            raise _failed(error) from error

    def _run(self, container: Container, visit: Visit, mark: str) -> int:
        tty = sys.stdin.isatty() and sys.stdout.isatty()
        stream = ExecStream(
            self._client.api,
            str(container.id),
            visit.words,
            tty=tty,
            user=_user(visit),
            workdir=WORKSPACE,
            environment={**visit.environment(os.environ), VARIABLE: mark},
        )
        try:
            return stream.run()
        finally:
            stream.close()

    def _open(self, visit: Visit, mark: str) -> tuple[Container, ExecStream]:
        """Return the lab's container and a lease on it; made anew if the last is just ending."""
        deadline = time.monotonic() + OPEN_SECONDS
        while True:
            container = self._running(visit) or self._start(visit)
            lease = self._lease(container, visit, mark) if container is not None else None
            if container is not None and lease is not None:
                return container, lease
            if time.monotonic() > deadline:
                raise SurroundingsError(
                    say("the lab's container does not start"), remedy=_remedy_for(visit)
                )
            time.sleep(POLL_SECONDS)

    def _running(self, visit: Visit) -> Container | None:
        try:
            found = self._client.containers.get(_name(visit))
        except NotFound:
            return None
        return found if found.status == "running" else None

    def _start(self, visit: Visit) -> Container | None:
        """Make and start the container; None if another lab has been faster."""
        owner = visit.workspace.owner
        try:
            made = self._client.containers.create(
                self._image,
                KEEPER,
                entrypoint=[],
                name=_name(visit),
                hostname=visit.hostname,
                user=_user(visit),
                working_dir="/",
                labels={LABEL: _hash(visit)},
                init=True,
                auto_remove=True,
                cap_drop=["ALL"],
                security_opt=["no-new-privileges"],
                network_mode="bridge",
                shm_size=SHARED_MEMORY,
                tmpfs={HOME: f"exec,mode=0755,uid={owner.uid},gid={owner.gid}"},
                mounts=list(_mounts(visit)),
            )
        except APIError as error:
            if error.status_code == 409:  # the name is taken
                self._clear_away(visit)
                return None
            raise
        try:
            if owner != IMAGE_USER:
                made.put_archive("/etc", _packed_accounts(owner))
            made.start()
        except BaseException:
            _remove(made)
            raise
        return made

    def _clear_away(self, visit: Visit) -> None:
        """Remove a container of ours that has ended and was left (a daemon that was killed)."""
        try:
            found = self._client.containers.get(_name(visit))
        except NotFound:
            return
        if found.status in ("exited", "dead") and found.labels.get(LABEL) == _hash(visit):
            _remove(found)

    def _lease(self, container: Container, visit: Visit, mark: str) -> ExecStream | None:
        try:
            lease = ExecStream(
                self._client.api,
                str(container.id),
                [*KEEPER, "lease", mark],
                user=_user(visit),
                workdir="/",
            )
        except APIError:  # it has ended meanwhile
            return None
        if lease.read_line(OPEN_SECONDS) == READY:
            return lease
        lease.close()
        return None


def _leave(container: Container, lease: ExecStream) -> None:
    """End the lease; after the last one, wait until the container is gone."""
    lease.end_input()
    last = lease.read_line(END_SECONDS) == LAST
    lease.close()
    deadline = time.monotonic() + END_SECONDS
    while last and time.monotonic() < deadline:
        try:
            container.reload()
        except NotFound:
            return
        time.sleep(POLL_SECONDS)  # (`wait` answers an error if it is removed in between)


def _remove(container: Container) -> None:
    try:
        container.remove(force=True)
    except APIError:
        return  # it removes itself


def _must_be_here(client: docker.DockerClient) -> None:
    """Refuse a daemon that cannot mount this machine's folders as the student's."""
    address = str(client.api.base_url)
    options = client.info().get("SecurityOptions") or []
    if urlsplit(address).hostname not in HERE:
        raise SurroundingsError(
            say(
                "Docker's daemon is not on this machine ({address}): the workspace cannot be "
                "mounted",
                address=address,
            ),
            remedy=say("Unset DOCKER_HOST, or use SANDBOX=bubblewrap."),
        )
    if any("rootless" in str(option) for option in options):
        raise SurroundingsError(
            say("Docker runs rootless here: files made in the lab would belong to another user id"),
            remedy=say("Use SANDBOX=bubblewrap."),
        )


def _user(visit: Visit) -> str:
    return f"{visit.workspace.owner.uid}:{visit.workspace.owner.gid}"


def _mounts(visit: Visit) -> Iterator[Mount]:
    yield Mount(WORKSPACE, str(visit.workspace.path), type="bind")
    if visit.lesson.folder is not None:
        lesson = str(visit.lesson.folder)
        yield Mount(visit.lesson.place, lesson, type="bind", read_only=True)


def _hash(visit: Visit) -> str:
    """Return what tells labs apart: what is mounted in a container cannot be changed any more."""
    owner = visit.workspace.owner
    text = f"{visit.workspace.path}\0{owner.uid}\0{owner.gid}"
    if visit.lesson.folder is not None:
        text += f"\0{visit.lesson.folder}"
    return hashlib.sha256(os.fsencode(text)).hexdigest()[:16]


def _name(visit: Visit) -> str:
    return f"ros2-teaching-lab-{visit.distro.name}-{_hash(visit)}"


def _packed_accounts(owner: Student) -> bytes:
    """Return a tar with the files of the lab's accounts."""
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
            say("the lab's image has been removed"), remedy=say("Make it again: make images")
        )
    said = error.explanation if isinstance(error, APIError) and error.explanation else str(error)
    return SurroundingsError(
        say("Docker could not go on with the lab: {problem}", problem=said),
        remedy=say("Is the daemon still running (docker info)? Without it: SANDBOX=bubblewrap"),
    )


def _remedy_for(visit: Visit) -> str:
    return say(
        "See: docker logs {name}; then docker rm -f {name}, and try again.", name=_name(visit)
    )
