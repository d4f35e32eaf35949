"""Which kind of lab opens: `auto`, or the one that was asked for."""

from __future__ import annotations

import difflib
from collections.abc import Callable
from pathlib import Path

from grader.base.cache import Notify
from grader.base.errors import SurroundingsError, UsageError
from grader.base.i18n.message import joined, say
from grader.ros.distro import Distro
from lab.visit import Visit

KINDS = ("auto", "docker", "bubblewrap")
Enter = Callable[[Visit], int]


def choose(kind: str, distro: Distro, *, notify: Notify) -> Enter:
    """Return what opens a lab of this kind and returns its exit status; say which it is, and why.

    Raises UsageError for another kind, SurroundingsError where the lab cannot be had.
    """
    if kind not in KINDS:
        close = difflib.get_close_matches(kind.lower(), KINDS, n=1)
        hint = say("did you mean '{name}'?", name=close[0]) if close else ""
        known = say("Kinds: {names}.", names=", ".join(KINDS))
        raise UsageError(
            say("there is no lab of the kind '{kind}'", kind=kind), remedy=joined(hint, known)
        )
    if kind == "bubblewrap":
        return _bubblewrap(distro, notify)
    try:
        enter, image = _docker(distro)
    except SurroundingsError as error:
        if kind == "docker":
            raise
        return _without_docker(distro, error, notify)
    notify(say("opening ROS 2 {distro} in a container of {image}", distro=distro.name, image=image))
    return enter


def _docker(distro: Distro) -> tuple[Enter, str]:
    # each kind is loaded only when it is wanted: the one must not need the other's libraries
    from grader.ros.images import connect, find_image  # noqa: PLC0415
    from lab.container import ContainerLab  # noqa: PLC0415

    client = connect()
    image = find_image(client, distro, "lab")
    if image is None:
        raise SurroundingsError(
            say("Docker has no image of the {distro} lab", distro=distro.name),
            remedy=say("Make it once: make images DISTRO={distro}", distro=distro.name),
        )
    lab = ContainerLab(client, image)
    return lab.enter, image.tags[0] if image.tags else str(image.short_id)


def _bubblewrap(distro: Distro, notify: Notify) -> Enter:
    from grader.sandbox.proof import proven_ros  # noqa: PLC0415
    from lab.bubblewrap import BubblewrapLab  # noqa: PLC0415

    return BubblewrapLab(proven_ros(distro, notify=notify)).enter


def _without_docker(distro: Distro, error: SurroundingsError, notify: Notify) -> Enter:
    if distro.lock is None and not (Path("/opt/ros") / distro.name / "setup.bash").is_file():
        raise SurroundingsError(
            say(
                "ROS 2 {distro} has no wheels on PyPI, so its lab needs Docker, and {problem}",
                distro=distro.name,
                problem=error.message,
            ),
            remedy=error.remedy,
        )
    notify(
        say(
            "opening ROS 2 {distro} in bubblewrap, since {problem}",
            distro=distro.name,
            problem=error.message,
        )
    )
    return _bubblewrap(distro, notify)
