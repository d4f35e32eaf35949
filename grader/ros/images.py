"""The Docker images of the distros: names, availability and versions."""

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
from grader.ros.prefix import WITHOUT_DOCKER

if TYPE_CHECKING:
    from docker import DockerClient
    from docker.models.images import Image

Base = Literal["ros", "wheels"]
Stage = Literal["grade", "lab"]
REPOSITORY = "ros2-teaching-lab"
REPOSITORY_VARIABLE = "GRADER_IMAGES"
ROS_LABEL = "ros2-teaching-lab.ros"
VERSIONS = "/opt/ros/versions.json"
OLDEST_API = (1, 40)  # Docker 19.03
CONNECT_SECONDS = 20.0  # a daemon that hangs must not block us
REQUEST_SECONDS = 120.0


def repository() -> str:
    """Return the images' repository; $GRADER_IMAGES sets another one."""
    return os.environ.get(REPOSITORY_VARIABLE) or REPOSITORY


def image_name(distro: Distro, stage: Stage | Literal["base"], base: Base) -> str:
    """Return the name of an image."""
    return f"{repository()}:{stage}-{distro.name}" + ("-wheels" if base == "wheels" else "")


def connect(*, instead: str = WITHOUT_DOCKER) -> DockerClient:
    """Return a connection to the Docker daemon.

    Raises SurroundingsError if no daemon answers, this user may not use its socket, or the daemon
    is too old; its remedy ends with `instead`, the way without Docker.
    """
    # imported lazily: most commands do not need Docker
    import docker  # noqa: PLC0415
    import docker.errors  # noqa: PLC0415

    try:
        client = docker.from_env(timeout=int(CONNECT_SECONDS))
        version = str(client.version(api_version=False)["ApiVersion"])
    except (docker.errors.DockerException, OSError) as error:
        raise _unreachable(str(error), instead) from None
    client.api.timeout = int(REQUEST_SECONDS)
    if tuple(int(part) for part in version.split(".")[:2]) < OLDEST_API:
        raise SurroundingsError(
            say(
                "this Docker daemon is too old (API {version}; {needed} is needed)",
                version=version,
                needed=".".join(map(str, OLDEST_API)),
            ),
            remedy=joined(say("Update Docker to 19.03 or newer."), instead),
        )
    return client


def _unreachable(said: str, instead: str) -> SurroundingsError:
    if "Permission denied" in said or "PermissionError" in said:
        return SurroundingsError(
            say("this user has no permission to use the Docker daemon's socket"),
            remedy=joined(
                say(
                    "Join the group `docker` (sudo usermod -aG docker $USER, then log in again; its "
                    "members have the power of root)."
                ),
                instead,
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
            instead,
        ),
    )


def find_image(client: DockerClient, distro: Distro, stage: Stage = "grade") -> Image | None:
    """Return a distro's local image, preferably on the official base; None if there is none."""
    import docker.errors  # noqa: PLC0415

    for base in get_args(Base):
        try:
            return client.images.get(image_name(distro, stage, base))
        except docker.errors.ImageNotFound:
            continue
    return None


def image_versions(client: DockerClient, image: Image) -> dict[str, str]:
    """Return an image's versions of rclpy, rmw, colcon, setuptools and python.

    They are cached for each image, because reading them needs a container.
    """
    cached = cache_root() / "images" / f"{str(image.id).replace(':', '-')}.json"
    if cached.is_file():
        found: dict[str, str] = json.loads(cached.read_text(encoding="utf-8"))
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
    cached.parent.mkdir(parents=True, exist_ok=True)
    unfinished = cached.with_suffix(f".{os.getpid()}")
    unfinished.write_text(json.dumps(versions), encoding="utf-8")
    unfinished.replace(cached)
    return versions


@dataclass(frozen=True)
class ImageRow:
    """An image that can be built: `size` in bytes, None if it does not exist."""

    distro: str
    stage: Stage
    base: Base
    name: str
    size: int | None = None
    id: str = ""


def image_table(client: DockerClient) -> list[ImageRow]:
    """Return a row for every image that can be built for the known distros."""
    here = {tag: image for image in client.images.list() for tag in image.tags}
    rows = []
    for distro in distros().values():
        bases: tuple[Base, ...] = ("ros", "wheels") if distro.lock else ("ros",)
        for base in bases:
            for stage in get_args(Stage):
                name = image_name(distro, stage, base)
                image = here.get(name)
                size = int(image.attrs["Size"]) if image else None
                row = ImageRow(
                    distro.name, stage, base, name, size, image.short_id if image else ""
                )
                rows.append(row)
    return rows
