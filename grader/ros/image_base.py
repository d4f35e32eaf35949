"""What the images are built on: the official image if it can be had, else Debian for the wheels."""

from __future__ import annotations

import os
import subprocess
from dataclasses import replace
from typing import TYPE_CHECKING

from grader.base.cache import Notify
from grader.base.errors import SurroundingsError, UsageError
from grader.ros.distro import Distro
from grader.ros.image_build import WHEELS_BASE, Network, plain, root
from grader.ros.images import Base, repository

if TYPE_CHECKING:
    from docker import DockerClient

SUITE = "trixie"  # of the Debian that we make
SHOWN = 200  # characters of what the daemon says


def choose_base(
    client: DockerClient, distro: Distro, wanted: Base | None, network: Network, *, notify: Notify
) -> tuple[Base, Network]:
    """Return the base for a distro, and the network settings that name its image.

    Without a wish it is the official image, and the wheels where that cannot be had. A base image
    of the user's is one with ROS if it has the distro, else one for the wheels. The image is pulled, or
    made. Raises UsageError or SurroundingsError if there is none.
    """
    if wanted is None and network.base_image:
        require(client, network.base_image, distro, notify)
        wanted = "ros" if has_ros(client, network.base_image, distro) else "wheels"
    if wanted != "wheels":
        image = network.base_image or distro.pinned_image
        said = missing(client, image, notify)
        if not said:
            return "ros", network
        if wanted == "ros" or distro.lock is None:
            raise unavailable(image, said, distro)
        notify(f"{image} cannot be had: {said}\nbuilding on Debian and PyPI's ROS wheels instead")
    require_wheels(distro)
    return "wheels", replace(network, base_image=debian(client, distro, network, notify))


def require_wheels(distro: Distro) -> None:
    """Raise UsageError if PyPI has no wheels for a distro."""
    if distro.lock is None:
        raise UsageError(
            f"PyPI has no ROS wheels for {distro.name}",
            remedy=f"Use the official image: make images DISTRO={distro.name} BASE=ros",
        )


def debian(client: DockerClient, distro: Distro, network: Network, notify: Notify) -> str:
    """Return a Debian for the wheels: the user's, one made earlier, the official, or a new one."""
    if network.base_image:
        require(client, network.base_image, distro, notify)
        return network.base_image
    own = f"{repository()}:base"
    if is_here(client, own):
        return own
    said = missing(client, WHEELS_BASE, notify)
    if not said:
        return WHEELS_BASE
    script = root() / "docker" / "make_base.sh"
    words = [str(script), SUITE, own, *([network.apt_mirror] if network.apt_mirror else [])]
    if os.geteuid() != 0:
        raise SurroundingsError(
            f"{WHEELS_BASE} cannot be had: {said}",
            remedy="Make a Debian without a registry, then run this command again:\n  sudo "
            + " ".join(words),
        )
    notify(
        f"{WHEELS_BASE} cannot be had: {said}\nmaking a Debian with debootstrap (a minute or two)"
    )
    done = subprocess.run(words, capture_output=True, text=True, errors="replace", check=False)
    if done.returncode:
        raise SurroundingsError(
            f"no Debian can be made: {done.stderr.strip()}",
            remedy="Then run this command again. Another mirror: APT_MIRROR=http://…/debian",
        )
    return own


def is_here(client: DockerClient, image: str) -> bool:
    """Whether the daemon has an image."""
    import docker.errors  # noqa: PLC0415

    try:
        client.images.get(image)
    except docker.errors.ImageNotFound:
        return False
    return True


def missing(client: DockerClient, image: str, notify: Notify) -> str:
    """Return why an image is not here and cannot be pulled, "" if it is here (now)."""
    import docker.errors  # noqa: PLC0415
    import requests  # noqa: PLC0415

    if is_here(client, image):
        return ""
    notify(f"getting {image}")
    try:
        for line in client.api.pull(image, stream=True, decode=True):
            if "error" in line:
                return plain(str(line["error"]))[:SHOWN]
    except (docker.errors.DockerException, requests.RequestException) as error:
        said = getattr(error, "explanation", None) or error
        return plain(str(said))[:SHOWN]
    return "" if is_here(client, image) else "it was not found"


def require(client: DockerClient, image: str, distro: Distro, notify: Notify) -> None:
    """Raise SurroundingsError if a base image that the user has named cannot be had."""
    said = missing(client, image, notify)
    if said:
        raise SurroundingsError(
            f"the base image {image} cannot be had: {said}",
            remedy=f"docker image ls shows what is here. Without BASE_IMAGE, make images "
            f"DISTRO={distro.name} chooses a base itself.",
        )


def has_ros(client: DockerClient, image: str, distro: Distro) -> bool:
    """Whether an image has a distro at /opt/ros."""
    import docker.errors  # noqa: PLC0415

    made = client.api.create_container(image, ["true"])["Id"]
    try:
        client.api.get_archive(made, f"/opt/ros/{distro.name}/setup.bash")
    except docker.errors.NotFound:
        return False
    finally:
        client.api.remove_container(made, force=True, v=True)
    return True


def unavailable(image: str, said: str, distro: Distro) -> SurroundingsError:
    """Return the error for an official image that cannot be had, with what leads on."""
    if distro.lock is not None:
        remedy = (
            f"Without a registry: make images DISTRO={distro.name} BASE=wheels builds on Debian and "
            "PyPI's ROS wheels."
        )
    else:
        remedy = (
            f"Connect to the registry (docker pull {image}), and run this command again. Or name an "
            f"image of yours that has ROS at /opt/ros/{distro.name}: make images "
            f"DISTRO={distro.name} BASE_IMAGE=name"
        )
    return SurroundingsError(f"{image} cannot be had: {said}", remedy=remedy)
