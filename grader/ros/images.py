"""The Docker images of the distros: their names, which of them are here, and what is in them."""

from __future__ import annotations

import io
import json
import os
import tarfile
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, get_args

from grader.base.cache import cache_root
from grader.base.errors import SurroundingsError
from grader.base.i18n.message import joined, say
from grader.ros.distro import Distro, distros

if TYPE_CHECKING:
    from docker import DockerClient
    from docker.models.images import Image

Base = Literal["ros", "wheels"]
Stage = Literal["grade", "lab"]
REPOSITORY = "ros2-teaching-lab"
REPOSITORY_VARIABLE = "GRADER_IMAGES"
DISTRO_LABEL = "ros2-teaching-lab.distro"
ROS_LABEL = "ros2-teaching-lab.ros"
STAGE_LABEL = "ros2-teaching-lab.stage"
VERSIONS = "/opt/ros/versions.json"
OLDEST_API = (1, 40)  # Docker 19.03
FIRST_ANSWER_SECONDS = 20.0  # a daemon that hangs must not hang us
ANSWER_SECONDS = 120.0
WITHOUT = say("Without Docker: SANDBOX=bubblewrap.")


def image_name(distro: Distro, stage: Stage | Literal["base"], base: Base) -> str:
    """Return an image's name; $GRADER_IMAGES names another repository."""
    repository = os.environ.get(REPOSITORY_VARIABLE) or REPOSITORY
    return f"{repository}:{stage}-{distro.name}" + ("-wheels" if base == "wheels" else "")


def connect() -> DockerClient:
    """Return a connection to the Docker daemon.

    Raises SurroundingsError where none answers, the socket is closed to this user, or the daemon
    is older than what is needed.
    """
    # a command that needs no Docker must not pay for its library
    import docker  # noqa: PLC0415
    import docker.errors  # noqa: PLC0415

    try:
        client = docker.from_env(timeout=int(FIRST_ANSWER_SECONDS))
        version = str(client.version(api_version=False)["ApiVersion"])
    except (docker.errors.DockerException, OSError) as error:
        raise _unreachable(str(error)) from None
    client.api.timeout = int(ANSWER_SECONDS)
    if tuple(int(part) for part in version.split(".")[:2]) < OLDEST_API:
        raise SurroundingsError(
            say(
                "this Docker daemon is too old (API {version}; {needed} is needed)",
                version=version,
                needed=".".join(map(str, OLDEST_API)),
            ),
            remedy=joined(say("Update Docker to 19.03 or newer."), WITHOUT),
        )
    return client


def _unreachable(said: str) -> SurroundingsError:
    if "Permission denied" in said or "PermissionError" in said:
        return SurroundingsError(
            say("you may not use the Docker daemon: its socket is closed to this user"),
            remedy=joined(
                say(
                    "Join the group `docker` (sudo usermod -aG docker $USER, then log in again; "
                    "that is as good as root), or use rootless Docker."
                ),
                WITHOUT,
            ),
        )
    address = os.environ.get("DOCKER_HOST") or say("its socket")
    return SurroundingsError(
        say("no Docker daemon answers at {address}", address=address),
        remedy=joined(
            say(
                "Start it (sudo systemctl start docker), or install it (Debian and Ubuntu: sudo "
                "apt-get install docker.io)."
            ),
            WITHOUT,
        ),
    )


def find_image(client: DockerClient, distro: Distro, stage: Stage = "grade") -> Image | None:
    """Return the image of a distro that is here, the one on the official base first."""
    import docker.errors  # noqa: PLC0415

    for base in get_args(Base):
        try:
            return client.images.get(image_name(distro, stage, base))
        except docker.errors.ImageNotFound:
            continue
    return None


def image_versions(client: DockerClient, image: Image) -> dict[str, str]:
    """Return what an image says of itself: rclpy, rmw, colcon, setuptools and python.

    Asked once for each image and kept in the cache, since it takes a container to ask.
    """
    kept = cache_root() / "images" / f"{str(image.id).replace(':', '-')}.json"
    if kept.is_file():
        found: dict[str, str] = json.loads(kept.read_text(encoding="utf-8"))
        return found
    container = client.api.create_container(str(image.id), ["true"])["Id"]
    try:
        packed, _ = client.api.get_archive(container, VERSIONS)
        with tarfile.open(fileobj=io.BytesIO(b"".join(packed))) as archive:
            member = archive.extractfile(archive.getmembers()[0])
            assert member is not None
            text = member.read().decode()
    finally:
        client.api.remove_container(container, force=True, v=True)
    versions = {str(key): str(value) for key, value in json.loads(text).items()}
    kept.parent.mkdir(parents=True, exist_ok=True)
    half = kept.with_suffix(f".{os.getpid()}")
    half.write_text(json.dumps(versions), encoding="utf-8")
    half.replace(kept)
    return versions


@dataclass(frozen=True)
class Row:
    """One image that could be: `size` in bytes, None where it is not here."""

    distro: str
    stage: Stage
    base: Base
    name: str
    size: int | None = None
    id: str = ""


def table(client: DockerClient) -> list[Row]:
    """Return a row for every image that the known distros could have."""
    here = {tag: image for image in client.images.list() for tag in image.tags}
    rows = []
    for distro in distros().values():
        bases: tuple[Base, ...] = ("ros", "wheels") if distro.lock else ("ros",)
        for base in bases:
            for stage in get_args(Stage):
                name = image_name(distro, stage, base)
                image = here.get(name)
                size = int(image.attrs["Size"]) if image else None
                row = Row(distro.name, stage, base, name, size, image.short_id if image else "")
                rows.append(row)
    return rows
