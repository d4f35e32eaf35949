"""What every request has to pass, and what every answer has: the page, its files, its websockets."""

from __future__ import annotations

import secrets
from typing import Any

from tornado.web import HTTPError, RequestHandler
from tornado.websocket import WebSocketHandler

from lab.window.access import Access

NONCE = b"{nonce}"
"""In a file of the page: the nonce of its style sheets, new in each answer."""


def policy(access: Access, nonce: str) -> str:
    """Return the Content-Security-Policy: nothing but our own files and our own websockets.

    The editor and the terminal make style sheets, which carry the nonce, and copy elements with
    their style attributes; no text becomes an element anywhere (trusted types: none).
    """
    return (
        f"default-src 'none'; script-src 'self'; style-src 'self' 'nonce-{nonce}'; "
        f"style-src-attr 'unsafe-inline'; img-src 'self'; connect-src 'self' {' '.join(access.sockets)}; base-uri 'none'; "
        "form-action 'none'; frame-ancestors 'none'; require-trusted-types-for 'script'; "
        "trusted-types 'none'"
    )


class Guarded(RequestHandler):
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


class File(Guarded):
    """One file of the page, or JSON made for it."""

    def initialize(self, **given: Any) -> None:
        super().initialize(**given)
        self._type, self._body = given["content"]

    async def get(self) -> None:
        body: bytes = self._body
        if self._is_page:
            nonce, access = secrets.token_urlsafe(16), self.access
            body = body.replace(NONCE, nonce.encode())
            self.set_header("Content-Security-Policy", policy(access, nonce))
            self.set_cookie(
                access.cookie,
                access.token,
                path=access.path,
                httponly=True,
                samesite="Strict",
                secure=access.front.startswith("https:"),
            )
        self.set_header("Content-Type", self._type)
        await self.finish(body)

    @property
    def _is_page(self) -> bool:
        return bool(self._type.startswith("text/html"))

    def _opens(self) -> bool:
        return self._is_page and self.access.is_token(self.get_query_argument("token", None))


class Missing(Guarded):
    """Any other address."""

    async def get(self) -> None:
        raise HTTPError(404)


class GuardedSocket(WebSocketHandler, Guarded):
    """A websocket of the page. A browser always sends its origin, so none is refused."""

    most = 64 * 1024  # bytes in one message of the page

    @property
    def max_message_size(self) -> int:
        """The longest message that is read; the connection ends with a longer one."""
        return self.most

    def check_origin(self, origin: str) -> bool:
        return self.access.is_origin(origin, self.request.headers.get("Host"))

    def prepare(self) -> None:
        super().prepare()
        if self.request.headers.get("Origin") is None:
            raise HTTPError(403, reason="Wrong Origin")
