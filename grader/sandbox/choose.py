"""Which sandbox marks: `auto`, or the one that was asked for; each is proven by opening it."""

from __future__ import annotations

import difflib
import os
from collections.abc import Sequence
from pathlib import Path

from grader.base.cache import Notify
from grader.base.errors import SurroundingsError, UsageError
from grader.base.i18n.message import joined, say
from grader.ros.distro import Distro
from grader.ros.prefix import BrokenRosError
from grader.sandbox.base import Sandbox
from grader.sandbox.limits import Limits
from grader.sandbox.proof import proven_ros

NAMES = ("auto", "docker", "bubblewrap", "account", "none")
DISPOSABLE = "GRADER_DISPOSABLE"
DOCKER_SOCKET = Path("/var/run/docker.sock")


def check_name(name: str) -> None:
    """Raise UsageError (with a "did you mean") if there is no sandbox of that name."""
    if name not in NAMES:
        close = difflib.get_close_matches(name.lower(), NAMES, n=1)
        hint = say("did you mean '{name}'?", name=close[0]) if close else ""
        known = say("Sandboxes: {names}.", names=", ".join(NAMES))
        raise UsageError(say("there is no sandbox '{name}'", name=name), remedy=joined(hint, known))


def open_sandbox(
    name: str, distro: Distro, limits: Limits, *, own_code: bool = False, notify: Notify = print
) -> Sandbox:
    """Return an opened sandbox over a ROS installation of that distro; the caller closes it.

    `own_code` allows `auto` to end at `none`, for a student's own package. `notify` hears of what is
    made on the way (a prefix, an image). Raises SurroundingsError where no sandbox is to be had,
    with cause and remedy.
    """
    check_name(name)
    tried: list[SurroundingsError] = []
    for choice in _choices(name, own_code=own_code):
        try:
            sandbox = _make(choice, distro, limits, notify, asked=name != "auto")
            if sandbox is not None:
                return sandbox.__enter__()
        except BrokenRosError:
            raise  # no other sandbox makes it run
        except SurroundingsError as error:
            tried.append(error)
    raise _none_opened(tried)


def _none_opened(tried: Sequence[SurroundingsError]) -> SurroundingsError:
    reasons = joined(*dict.fromkeys(error.message for error in tried), by="\n")
    return SurroundingsError(
        say("no sandbox to mark in: {reasons}", reasons=reasons),
        remedy=joined(*dict.fromkeys(error.remedy for error in tried), by="\n"),
    )


def _choices(name: str, *, own_code: bool) -> list[str]:
    if name != "auto":
        return [name]
    choices = ["docker", "bubblewrap"]
    if os.environ.get(DISPOSABLE) == "1":
        choices.append("account")
    return [*choices, "none"] if own_code else choices


def _make(
    choice: str, distro: Distro, limits: Limits, notify: Notify, *, asked: bool
) -> Sandbox | None:
    # each sandbox is loaded only when it is asked for: `grader --help` must not pay for it
    if choice == "docker":
        return _containers(distro, limits, notify, asked=asked)
    ros = proven_ros(distro, notify=notify)
    if choice == "bubblewrap":
        from grader.sandbox.bubblewrap import Bubblewrap  # noqa: PLC0415

        return Bubblewrap(ros, limits)
    from grader.sandbox import plain  # noqa: PLC0415

    return plain.Account(ros, limits) if choice == "account" else plain.Bare(ros, limits)


def _containers(distro: Distro, limits: Limits, notify: Notify, *, asked: bool) -> Sandbox | None:
    """Return the `docker` sandbox; None where `auto` asks and daemon or image are not there.

    An image is made only where docker was asked for by name: `auto` never pulls gigabytes.
    """
    if not asked and not os.environ.get("DOCKER_HOST") and not DOCKER_SOCKET.exists():
        return None
    from grader.ros import image_build, images  # noqa: PLC0415
    from grader.sandbox.containers import Containers  # noqa: PLC0415

    try:
        client = images.connect()
    except SurroundingsError:
        if asked:
            raise
        return None
    image = images.find_image(client, distro)
    if image is None and asked:
        network = image_build.Network()
        image_build.build_image(
            client, distro, stage="grade", base="ros", network=network, notify=notify
        )
        image = images.find_image(client, distro)
    if image is None:
        client.close()
        return None
    return Containers(client, image, distro, limits)
