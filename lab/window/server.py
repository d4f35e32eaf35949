"""The window's server: the page's files, and the websockets.

Tornado, because it is one package without further ones, does HTTP and websockets, and was locked
already (Dask needs it).
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from tornado.httpserver import HTTPServer
from tornado.iostream import IOStream
from tornado.web import Application

from lab.window.access import Access, Neighbourhood
from lab.window.guard import File, Missing
from lab.window.hub import Hub
from lab.window.sockets import RosSocket, TerminalSocket, WorkSocket
from lab.window.work import Work

FILES = Path(__file__).resolve().parent / "page"
TYPES = {
    ".html": "text/html; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".svg": "image/svg+xml",
}
MOST_HEADERS = 16 * 1024  # bytes
MOST_BODY = 64 * 1024
PING_SECONDS = 20


class _Server(HTTPServer):
    """Closes connections from other machines and containers without an answer."""

    neighbours = Neighbourhood()

    def handle_stream(self, stream: IOStream, address: tuple[Any, ...]) -> None:
        # (a Unix socket has no address: whoever may open its file may connect)
        if not address or self.neighbours.is_answered(str(address[0])):
            super().handle_stream(stream, address)
        else:
            stream.close()


def make_server(
    access: Access,
    hub: Hub,
    texts: dict[str, Any],
    neighbours: Neighbourhood,
    work: Work | None = None,
) -> HTTPServer:
    """Return the server; `texts` are the page's, in its language. Only a lab has `work`."""
    made = ("application/json", json.dumps(texts, ensure_ascii=False).encode())
    routes: list[Any] = [
        ("/socket", RosSocket, {"access": access, "hub": hub}),
        ("/texts.json", File, {"access": access, "content": made}),
    ]
    if work is not None:
        routes += [
            ("/work", WorkSocket, {"access": access, "work": work}),
            (
                r"/terminal/(\d{1,9})",
                TerminalSocket,
                {"access": access, "terminals": work.terminals},
            ),
        ]
    for path in sorted(FILES.rglob("*")):
        if path.suffix in TYPES:
            name = path.relative_to(FILES).as_posix()
            address = "/" if name == "index.html" else f"/{name}"
            content = (TYPES[path.suffix], path.read_bytes())
            routes.append((address, File, {"access": access, "content": content}))
    application = Application(
        routes,
        default_handler_class=Missing,
        default_handler_args={"access": access},
        log_function=lambda _: None,
        websocket_ping_interval=PING_SECONDS,
    )
    server = _Server(application, max_header_size=MOST_HEADERS, max_body_size=MOST_BODY)
    server.neighbours = neighbours
    return server
