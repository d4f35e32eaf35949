"""The websockets of the page: ROS, the work in the workspace, and a terminal."""

from __future__ import annotations

import asyncio
import contextlib
import json
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError
from tornado.iostream import StreamClosedError
from tornado.websocket import WebSocketClosedError

from lab.window.guard import GuardedSocket
from lab.window.hub import Hub, Page
from lab.window.protocol import ASKED as ASKED_OF_ROS
from lab.window.terminals import Terminals, Viewer
from lab.window.work import Work
from lab.window.work_protocol import ASKED as ASKED_OF_WORK

NOT_UNDERSTOOD = (1008, "not understood")
NO_TERMINAL = (4004, "no such terminal")
ENDED = (4000, "ended")
MOST_TEXT = 5_000_000  # bytes of a message with a file's text


class RosSocket(GuardedSocket):
    """What the nodes do."""

    def initialize(self, **given: Any) -> None:
        super().initialize(**given)
        self._hub: Hub = given["hub"]
        self._page: Page | None = None
        self._sender: asyncio.Task[None] | None = None

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
            self._page.ask(ASKED_OF_ROS.validate_json(message))
        except ValidationError:
            self.close(*NOT_UNDERSTOOD)

    def on_close(self) -> None:
        if self._sender is not None:
            self._sender.cancel()
        if self._page is not None:
            self._hub.close(self._page)


class WorkSocket(GuardedSocket):
    """Files, guide and check."""

    most = MOST_TEXT

    def initialize(self, **given: Any) -> None:
        super().initialize(**given)
        self._work: Work = given["work"]

    def open(self, *_: str, **__: str) -> None:
        self._work.open(self._send)

    def _send(self, message: dict[str, Any]) -> None:
        with contextlib.suppress(WebSocketClosedError, StreamClosedError):
            self.write_message(json.dumps(message, separators=(",", ":"), ensure_ascii=False))

    async def on_message(self, message: str | bytes) -> None:
        try:
            asked = ASKED_OF_WORK.validate_json(message)
        except ValidationError:
            self.close(*NOT_UNDERSTOOD)
            return
        answer = await self._work.answer(asked)
        if answer is not None:
            self._send(answer)

    def on_close(self) -> None:
        self._work.close(self._send)


class _Typed(BaseModel):
    """What a page says to a terminal: keys, its size in rows and columns, bytes that it has shown."""

    model_config = ConfigDict(extra="forbid", strict=True)

    type: str = ""
    size: Annotated[list[int], Field(max_length=2)] = []
    took: int = Field(default=0, ge=0)


class TerminalSocket(GuardedSocket):
    """One terminal: bytes of its output to the page, keys from it."""

    def initialize(self, **given: Any) -> None:
        super().initialize(**given)
        self._terminals: Terminals = given["terminals"]
        self._viewer: Viewer | None = None
        self._number = 0

    def open(self, *number: str, **_: str) -> None:
        self._number = int(number[0])
        terminal = self._terminals.get(self._number)
        if terminal is None:
            self.close(*NO_TERMINAL)
            return
        self.set_nodelay(True)
        self._viewer = terminal.view(self._send, self._end)
        self._text({"history": self._viewer.waiting})
        terminal.flow()

    def _text(self, message: dict[str, Any]) -> None:
        with contextlib.suppress(WebSocketClosedError, StreamClosedError):
            self.write_message(json.dumps(message))

    def _send(self, data: bytes) -> None:
        with contextlib.suppress(WebSocketClosedError, StreamClosedError):
            self.write_message(data, binary=True)

    def _end(self) -> None:
        self.close(*ENDED)

    def on_message(self, message: str | bytes) -> None:
        try:
            typed = _Typed.model_validate_json(message)
        except ValidationError:
            self.close(*NOT_UNDERSTOOD)
            return
        terminal = self._terminals.get(self._number)
        if terminal is None or self._viewer is None:
            return
        if len(typed.size) == 2:
            terminal.resize(*typed.size)
        if typed.type:
            terminal.type(typed.type)
        if typed.took:
            self._viewer.took(typed.took)

    def on_close(self) -> None:
        terminal = self._terminals.get(self._number)
        if terminal is not None and self._viewer is not None:
            terminal.leave(self._viewer)
