"""The window's server: the page's files, and the websocket.

Tornado, because it is one package without further ones, does HTTP and websockets, and was locked
already (Dask needs it).
"""

from __future__ import annotations

import asyncio
import contextlib
import json
from pathlib import Path
from typing import Any

from pydantic import ValidationError
from tornado.httpserver import HTTPServer
from tornado.iostream import IOStream, StreamClosedError
from tornado.web import Application, HTTPError, RequestHandler
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from lab.window.access import Access, Neighbourhood
from lab.window.hub import Hub, Page
from lab.window.protocol import ASKED

FILES = Path(__file__).resolve().parent / "page"
TYPES = {
    ".html": "text/html; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".svg": "image/svg+xml",
}
MOST_HEADERS = 16 * 1024  # bytes
MOST_ASKED = 64 * 1024  # bytes in one message of the page
PING_SECONDS = 20


def policy(port: int) -> str:
    """Return the Content-Security-Policy: nothing but our own files and our own websocket."""
    sockets = " ".join(f"ws://{host}:{port}" for host in ("127.0.0.1", "localhost"))
    return (
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self'; "
        f"connect-src 'self' {sockets}; base-uri 'none'; form-action 'none'; "
        "frame-ancestors 'none'; require-trusted-types-for 'script'; trusted-types 'none'"
    )


class _Guarded(RequestHandler):
    """A handler that answers only the student's own browser."""

    access: Access

    def initialize(self, **given: Any) -> None:
        self.access = given["access"]

    def set_default_headers(self) -> None:
        self.clear_header("Server")
        self.set_header("Cache-Control", "no-store")
        self.set_header("X-Content-Type-Options", "nosniff")
        self.set_header("Referrer-Policy", "no-referrer")
        self.set_header("Cross-Origin-Resource-Policy", "same-origin")
        self.set_header("Cross-Origin-Opener-Policy", "same-origin")

    def prepare(self) -> None:
        """Refuse a request with a wrong host, origin or token (HTTPError 403)."""
        headers = self.request.headers
        host, origin = headers.get("Host"), headers.get("Origin")
        if not self.access.is_host(host):
            raise HTTPError(403, reason="Wrong Host")
        if origin is not None and not self.access.is_origin(origin, host):
            raise HTTPError(403, reason="Wrong Origin")
        if not (self.access.is_token(self._cookie()) or self._opens()):
            raise HTTPError(403, reason="Wrong Token")

    def _cookie(self) -> str | None:
        return self.get_cookie(self.access.cookie)

    def _opens(self) -> bool:
        """Whether the request has the token in its address, as the first one has."""
        return False

    def write_error(self, status_code: int, **_: Any) -> None:
        """Answer in one line; in English, because a stranger may ask."""
        self.set_header("Content-Type", "text/plain; charset=utf-8")
        texts = {403: "Open the address that the command printed.\n", 404: "No such file.\n"}
        self.finish(texts.get(status_code, f"{status_code}\n"))


class _File(_Guarded):
    """One file of the page, or JSON made for it."""

    def initialize(self, **given: Any) -> None:
        super().initialize(**given)
        self._type, self._body = given["content"]

    async def get(self) -> None:
        if self._type.startswith("text/html"):
            self.set_header("Content-Security-Policy", policy(self.access.port))
            self.set_cookie(self.access.cookie, self.access.token, httponly=True, samesite="Strict")
        self.set_header("Content-Type", self._type)
        await self.finish(self._body)

    def _opens(self) -> bool:
        is_page = self._type.startswith("text/html")
        return is_page and self.access.is_token(self.get_query_argument("token", None))


class _Missing(_Guarded):
    async def get(self) -> None:
        raise HTTPError(404)


class _Socket(WebSocketHandler, _Guarded):
    """The websocket of one page."""

    def initialize(self, **given: Any) -> None:
        super().initialize(**given)
        self._hub: Hub = given["hub"]
        self._page: Page | None = None
        self._sender: asyncio.Task[None] | None = None

    def check_origin(self, origin: str) -> bool:
        return self.access.is_origin(origin, self.request.headers.get("Host"))

    def prepare(self) -> None:
        super().prepare()
        if self.request.headers.get("Origin") is None:  # a browser always sends it
            raise HTTPError(403, reason="Wrong Origin")

    def open(self, *_: str, **__: str) -> None:
        self._page = self._hub.open()
        self._sender = asyncio.create_task(self._send(self._page))

    async def _send(self, page: Page) -> None:
        with contextlib.suppress(WebSocketClosedError, StreamClosedError):
            while True:
                await self.write_message(await page.frame())

    def on_message(self, message: str | bytes) -> None:
        assert self._page is not None
        try:
            self._page.ask(ASKED.validate_json(message))
        except ValidationError:
            self.close(1008, "not understood")

    def on_close(self) -> None:
        if self._sender is not None:
            self._sender.cancel()
        if self._page is not None:
            self._hub.close(self._page)


class _Server(HTTPServer):
    """Closes connections from other machines and containers without an answer."""

    neighbours = Neighbourhood()

    def handle_stream(self, stream: IOStream, address: tuple[Any, ...]) -> None:
        if self.neighbours.is_answered(str(address[0])):
            super().handle_stream(stream, address)
        else:
            stream.close()


def make_server(
    access: Access, hub: Hub, texts: dict[str, Any], neighbours: Neighbourhood
) -> HTTPServer:
    """Return the server; `texts` are the page's, in its language."""
    made = ("application/json", json.dumps(texts, ensure_ascii=False).encode())
    routes: list[Any] = [
        ("/socket", _Socket, {"access": access, "hub": hub}),
        ("/texts.json", _File, {"access": access, "content": made}),
    ]
    for path in sorted(FILES.rglob("*")):
        if path.suffix in TYPES:
            name = path.relative_to(FILES).as_posix()
            address = "/" if name == "index.html" else f"/{name}"
            content = (TYPES[path.suffix], path.read_bytes())
            routes.append((address, _File, {"access": access, "content": content}))
    application = Application(
        routes,
        default_handler_class=_Missing,
        default_handler_args={"access": access},
        log_function=lambda _: None,
        websocket_ping_interval=PING_SECONDS,
        websocket_max_message_size=MOST_ASKED,
    )
    server = _Server(application, max_header_size=MOST_HEADERS, max_body_size=MOST_ASKED)
    server.neighbours = neighbours
    return server
