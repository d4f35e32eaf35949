"""Selects the sandbox for marking. A sandbox is proven to work by opening it."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from grader.base.cache import Notify
from grader.base.errors import SurroundingsError
from grader.base.i18n.message import joined, say
from grader.ros import image_base, image_build, images
from grader.ros.distro import Distro
from grader.ros.prefix import BrokenRosError, Ros, instead_of_docker
from grader.sandbox.base import Sandbox
from grader.sandbox.bubblewrap import Bubblewrap
from grader.sandbox.limits import Limits
from grader.sandbox.names import check_name
from grader.sandbox.plain import AccountSandbox, NoSandbox
from grader.sandbox.proof import proven_ros

DISPOSABLE = "GRADER_DISPOSABLE"
DOCKER_SOCKET = Path("/var/run/docker.sock")


def open_sandbox(
    name: str,
    distro: Distro,
    limits: Limits,
    *,
    interfaces: Sequence[str] = (),
    own_code: bool = False,
    notify: Notify = print,
) -> Sandbox:
    """Return an open sandbox with a ROS installation of that distro; the caller closes it.

    ROS has the packages `interfaces` (see `with_interfaces`). `own_code` allows `auto` to fall back to `none`, for a student's own package. `notify` is called
    with progress texts while a prefix or an image is made. Raises SurroundingsError with cause and
    remedy if no sandbox is available.
    """
    check_name(name)
    tried: list[SurroundingsError] = []
    for choice in _choices(name, own_code=own_code):
        try:
            if choice == "docker":
                sandbox = _docker(distro, limits, notify, required=name != "auto")
            else:
                ros = proven_ros(distro, interfaces=interfaces, notify=notify)
                sandbox = _make(choice, ros, limits)
            if sandbox is not None:
                return sandbox.__enter__()
        except BrokenRosError:
            raise  # it would not run in another sandbox either
        except SurroundingsError as error:
            tried.append(error)
    raise _none_opened(tried)


def _none_opened(tried: Sequence[SurroundingsError]) -> SurroundingsError:
    reasons = joined(*dict.fromkeys(error.message for error in tried), by="\n")
    return SurroundingsError(
        say("no sandbox is available: {reasons}", reasons=reasons),
        remedy=joined(*dict.fromkeys(error.remedy for error in tried), by="\n"),
    )


def _choices(name: str, *, own_code: bool) -> list[str]:
    if name != "auto":
        return [name]
    choices = ["docker", "bubblewrap"]
    if os.environ.get(DISPOSABLE) == "1":
        choices.append("account")
    return [*choices, "none"] if own_code else choices


def _make(choice: str, ros: Ros, limits: Limits) -> Sandbox:
    if choice == "bubblewrap":
        return Bubblewrap(ros, limits)
    return AccountSandbox(ros, limits) if choice == "account" else NoSandbox(ros, limits)


def _docker(distro: Distro, limits: Limits, notify: Notify, *, required: bool) -> Sandbox | None:
    """Return the `docker` sandbox; None if it is not `required` and daemon or image are missing.

    An image is built only if it is required: `auto` never pulls gigabytes.
    """
    if not required and not os.environ.get("DOCKER_HOST") and not DOCKER_SOCKET.exists():
        return None
    # imports docker, which the other sandboxes do not need
    from grader.sandbox.docker_sandbox import DockerSandbox  # noqa: PLC0415

    try:
        client = images.connect(instead=instead_of_docker(distro))
    except SurroundingsError:
        if required:
            raise
        return None
    image = images.find_image(client, distro)
    if image is None and required:
        base, network = image_base.choose_base(
            client, distro, None, image_build.Network(), notify=notify
        )
        image_build.build_image(
            client, distro, stage="grade", base=base, network=network, notify=notify
        )
        image = images.find_image(client, distro)
    if image is None:
        client.close()
        return None
    return DockerSandbox(client, image, distro, limits)
