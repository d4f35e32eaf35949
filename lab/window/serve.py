"""Serves the window: the page's server, the bridge and the work, until the task is cancelled."""

from __future__ import annotations

import asyncio
import errno
import ipaddress
import logging
import os
import socket
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

from tornado.netutil import bind_sockets, bind_unix_socket

from grader.base.errors import SurroundingsError, UsageError
from grader.base.i18n.message import say
from lab.ros_packages import TURTLESIM, has_package
from lab.window.access import Access, Neighbourhood, neighbourhood
from lab.window.hub import Hub
from lab.window.keeper import CHANNEL
from lab.window.link import Link
from lab.window.published import IN_PAGE, TOKEN
from lab.window.server import make_server
from lab.window.texts import page_texts
from lab.window.work import Work

Ready = Callable[[str], None]
"""Called with the address, once the page can be opened."""
FOR_OWNER = 0o600
KEEPER = Path(__file__).resolve().parent / "keeper.py"
OWN = ("LAB_WINDOW_", "LAB_PAGE_")
"""How the variables begin that are not for the terminals of the page."""


@dataclass(frozen=True)
class Place:
    """Where the window listens: host and port, a Unix socket, or a socket that is open already.

    `front` is the address of the page if another server passes its requests on.
    """

    host: str = "127.0.0.1"
    port: int = 0
    unix: Path | None = None
    descriptor: int | None = None
    front: str = ""


def kept(place: Place, words: Sequence[str], ready: Ready) -> NoReturn:
    """Become the keeper of a lab's shells, which starts the page's server: `words`, and again.

    It has the address, so that the page finds the next server there.
    """
    sockets, access = _listening(place, os.environ.get(TOKEN, ""))
    ready(access.address)
    listener = sockets[0].detach()
    os.set_inheritable(listener, True)
    os.environ[TOKEN] = access.token
    keeper = [sys.executable, "-I", "-S", str(KEEPER), str(listener)]
    os.execv(sys.executable, [*keeper, *words])  # noqa: S606 - no shell is needed


def serve(place: Place, lang: str, environment: Mapping[str, str], ready: Ready) -> None:
    """Serve the window until Ctrl+C (KeyboardInterrupt); nothing is left running.

    Raises SurroundingsError if ROS is not set up or the place is taken, UsageError for a wrong one.
    """
    asyncio.run(_serve(place, lang, environment, ready))


async def _serve(place: Place, lang: str, environment: Mapping[str, str], ready: Ready) -> None:
    logging.getLogger("tornado.access").disabled = True
    hub = Hub()
    link = Link(environment, hub.receive)
    hub.bridge = link
    work = _work(lang, environment, hub)
    sockets, access = _listening(place, environment.get(TOKEN, ""))
    outside = place.unix is None and not ipaddress.ip_address(place.host).is_loopback
    neighbours = neighbourhood() if outside else Neighbourhood()
    has_turtlesim = has_package(TURTLESIM, environment)
    texts = page_texts(lang, has_turtlesim=has_turtlesim, has_lab=work is not None)
    server = make_server(access, hub, texts, neighbours, work)
    server.add_sockets(sockets)
    running = [asyncio.create_task(link.run())]
    if work is not None:
        hub.on_graph = work.graph_changed
        running.append(asyncio.create_task(work.run()))
    try:
        ready(access.address)
        await asyncio.Event().wait()
    finally:
        server.stop()
        for task in running:
            task.cancel()
        await asyncio.gather(*running, return_exceptions=True)
        await server.close_all_connections()


def _work(lang: str, environment: Mapping[str, str], hub: Hub) -> Work | None:
    """Return the work of the lab in which this program runs; None if it is in no lab."""
    if not environment.get("LAB_PROGRAMS"):
        return None
    from lab.guide.opened import opened_lab  # noqa: PLC0415 - not without a lab

    own = {name: value for name, value in environment.items() if not name.startswith(OWN)}
    own |= {"TERM": "xterm-256color", "COLORTERM": "truecolor", IN_PAGE: "1"}
    channel = environment.get(CHANNEL)
    return Work(opened_lab(lang), own, hub.graph, int(channel) if channel else None)


def _listening(place: Place, token: str) -> tuple[list[socket.socket], Access]:
    more = {"front": place.front} | ({"token": token} if token else {})
    if place.unix is not None:
        if not place.front:
            raise UsageError(
                say("with --socket, the address of the page has to be known"),
                remedy=say("Add --front https://HOST/PATH/, as the browser has it."),
            )
        return [_bound_unix(place.unix)], Access(0, **more)
    if place.descriptor is not None:
        given = socket.socket(fileno=place.descriptor)
        given.set_inheritable(False)
        given.setblocking(False)
        port = given.getsockname()[1] if given.family == socket.AF_INET else 0
        return [given], Access(port, **more)
    sockets = _bound(place.host, place.port)
    return sockets, Access(sockets[0].getsockname()[1], **more)


def _bound_unix(path: Path) -> socket.socket:
    try:
        return bind_unix_socket(str(path), mode=FOR_OWNER)
    except (OSError, ValueError) as error:  # (ValueError: it is a file)
        said = error.strerror if isinstance(error, OSError) else str(error)
        raise SurroundingsError(
            say("cannot listen on {host}: {reason}", host=str(path), reason=str(said)),
            remedy=say("Choose a path in a folder of your own."),
        ) from error


def _bound(host: str, port: int) -> list[socket.socket]:
    try:
        ipaddress.IPv4Address(host)
    except ValueError as error:
        raise UsageError(
            say("'{host}' is not an IPv4 address", host=host),
            remedy=say("Remove --host, or use 127.0.0.1."),
        ) from error
    try:
        return bind_sockets(port, host, family=socket.AF_INET)
    except OSError as error:
        if error.errno == errno.EADDRINUSE:
            raise SurroundingsError(
                say("port {port} is in use", port=port),
                remedy=say(
                    "Perhaps another terminal of this lab has the window open: use that one, or end "
                    "it with Ctrl+C. --port 0 chooses a free port."
                ),
            ) from error
        raise SurroundingsError(
            say("cannot listen on {host}: {reason}", host=host, reason=str(error.strerror)),
            remedy=say("Remove --host, or use 127.0.0.1."),
        ) from error
