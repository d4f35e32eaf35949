"""Serves the window: the page's server and the bridge, until the task is cancelled."""

from __future__ import annotations

import asyncio
import errno
import ipaddress
import logging
import socket
from collections.abc import Callable, Mapping

from tornado.netutil import bind_sockets

from grader.base.errors import SurroundingsError, UsageError
from grader.base.i18n.message import say
from lab.window.access import Access, Neighbourhood, neighbourhood
from lab.window.hub import Hub
from lab.window.link import Link
from lab.window.server import make_server
from lab.window.texts import page_texts

Ready = Callable[[str], None]
"""Called with the address, once the page can be opened."""


def serve(host: str, port: int, lang: str, environment: Mapping[str, str], ready: Ready) -> None:
    """Serve the window until Ctrl+C (KeyboardInterrupt); nothing is left running.

    Raises SurroundingsError if ROS is not set up or the port is in use, UsageError for a wrong host.
    """
    asyncio.run(_serve(host, port, lang, environment, ready))


async def _serve(
    host: str, port: int, lang: str, environment: Mapping[str, str], ready: Ready
) -> None:
    logging.getLogger("tornado.access").disabled = True
    hub = Hub()
    link = Link(environment, hub.receive)
    hub.bridge = link
    sockets = _bound(host, port)
    access = Access(sockets[0].getsockname()[1])
    outside = not ipaddress.ip_address(host).is_loopback
    neighbours = neighbourhood() if outside else Neighbourhood()
    server = make_server(access, hub, page_texts(lang), neighbours)
    server.add_sockets(sockets)
    running = asyncio.create_task(link.run())
    try:
        ready(access.address)
        await asyncio.Event().wait()
    finally:
        server.stop()
        running.cancel()
        await asyncio.gather(running, return_exceptions=True)
        await server.close_all_connections()


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
