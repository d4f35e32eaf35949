"""Selects how the lab is opened: in Docker or with bubblewrap."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from grader.base.cache import Notify
from grader.base.errors import SurroundingsError, UsageError
from grader.base.i18n.message import joined, say
from grader.base.nearest import did_you_mean
from grader.ros.distro import Distro
from grader.ros.images import connect, find_image
from grader.ros.interfaces import with_turtlesim
from grader.ros.prefix import has_system_ros, instead_of_docker
from grader.sandbox.proof import proven_ros
from lab.bubblewrap import BubblewrapLab
from lab.config import LabConfig

KINDS = ("auto", "docker", "bubblewrap")
Enter = Callable[[LabConfig], int]
"""Opens a lab and returns the exit status of its command."""


def choose(kind: str, distro: Distro, *, interfaces: Sequence[str] = (), notify: Notify) -> Enter:
    """Return the function that opens a lab of this kind; report the choice with `notify`.

    ROS has the packages `interfaces`, and with them what builds a student's own. turtlesim is there
    wherever it can be had.

    Raises UsageError for an unknown kind, SurroundingsError if the lab is not available.
    """
    if kind not in KINDS:
        known = say("Sandboxes: {names}.", names=", ".join(KINDS))
        raise UsageError(
            say("there is no lab sandbox '{kind}'", kind=kind),
            remedy=joined(did_you_mean(kind, KINDS), known),
        )
    if kind == "bubblewrap":
        return _bubblewrap(distro, interfaces, notify)
    try:
        enter, image = _docker(distro)
    except SurroundingsError as error:
        if kind == "docker":
            raise
        return _without_docker(distro, error, interfaces, notify)
    notify(
        say("opening ROS 2 {distro} in a container from {image}", distro=distro.name, image=image)
    )
    return enter


def _docker(distro: Distro) -> tuple[Enter, str]:
    # imports docker, which the lab with bubblewrap does not need
    from lab.container import ContainerLab  # noqa: PLC0415

    client = connect(instead=instead_of_docker(distro))
    image = find_image(client, distro, "lab")
    if image is None:
        raise SurroundingsError(
            say("Docker has no lab image for {distro}", distro=distro.name),
            remedy=say("Build it: make images DISTRO={distro}", distro=distro.name),
        )
    lab = ContainerLab(client, image)
    return lab.enter, image.tags[0] if image.tags else str(image.short_id)


def _bubblewrap(distro: Distro, interfaces: Sequence[str], notify: Notify) -> Enter:
    ros = proven_ros(distro, interfaces=interfaces, notify=notify)
    return BubblewrapLab(with_turtlesim(ros, notify=notify)).enter


def _without_docker(
    distro: Distro, error: SurroundingsError, interfaces: Sequence[str], notify: Notify
) -> Enter:
    if distro.lock is None and not has_system_ros(distro):
        raise SurroundingsError(
            say(
                "ROS 2 {distro} has no wheels on PyPI, so its lab needs Docker, but {problem}",
                distro=distro.name,
                problem=error.message,
            ),
            remedy=error.remedy,
        )
    notify(
        say(
            "opening ROS 2 {distro} in bubblewrap because {problem}",
            distro=distro.name,
            problem=error.message,
        )
    )
    return _bubblewrap(distro, interfaces, notify)
