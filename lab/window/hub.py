"""Passes messages between the bridge and all pages that are open."""

from __future__ import annotations

import asyncio
import json
from collections import deque
from collections.abc import Callable
from typing import Any, Protocol

from lab.window.protocol import Asked, Drive, Restart, Watch

Message = dict[str, Any]
LOGS_KEPT = 1_000  # records, for a page that is opened later
MOST_QUEUED = 300  # messages to a page that does not read; the oldest are dropped
STATES = ("bridge", "graph", "turtles")  # of these only the newest message counts


class Bridge(Protocol):
    """The bridge as the hub sees it."""

    def send(self, command: Message) -> None:
        """Send a command."""

    def restart(self) -> None:
        """Start the bridge again."""


class Page:
    """One open page: what it looks at, and the messages that it has not got yet."""

    def __init__(self, hub: Hub) -> None:
        self._hub = hub
        self.views: set[str] = set()
        self.series: list[tuple[str, str]] = []
        self.seeks = False
        self._states: dict[str, Message] = {}
        self._queue: deque[Message] = deque(maxlen=MOST_QUEUED)
        self._news = asyncio.Event()

    def put(self, message: Message) -> None:
        """Add a message; a new state replaces the one that has not been sent."""
        if message["kind"] in STATES:
            self._states[message["kind"]] = message
        else:
            self._queue.append(message)
        self._news.set()

    async def frame(self) -> str:
        """Wait for messages and return all of them as one JSON array."""
        await self._news.wait()
        self._news.clear()
        messages = [*self._states.values(), *self._queue]
        self._states.clear()
        self._queue.clear()
        return json.dumps(messages, separators=(",", ":"))

    def ask(self, asked: Asked) -> None:
        """Carry out what the page asks."""
        self._hub.ask(self, asked)


class Hub:
    """The newest state, and the pages; the bridge is told what they look at together."""

    def __init__(self) -> None:
        self.bridge: Bridge | None = None
        self.on_graph: Callable[[], None] | None = None
        self._pages: set[Page] = set()
        self._states: dict[str, Message] = {}
        self._logs: deque[Message] = deque(maxlen=LOGS_KEPT)
        self._asked: dict[int, tuple[Page, int]] = {}
        self._last_id = 0

    def open(self) -> Page:
        """Add a page, and give it what is known."""
        page = Page(self)
        self._pages.add(page)
        for state in self._states.values():
            page.put(state)
        if self._logs:
            page.put({"kind": "log", "records": list(self._logs)})
        return page

    def graph(self) -> Message:
        """Return the newest graph; empty before the bridge has seen it."""
        return self._states.get("graph", {})

    def close(self, page: Page) -> None:
        """Remove a page."""
        self._pages.discard(page)
        self._watch()

    def ask(self, page: Page, asked: Asked) -> None:
        """Pass on what a page asks; an answer with an id comes back to that page only."""
        if self.bridge is None:
            return
        if isinstance(asked, Watch):
            page.views, page.series, page.seeks = set(asked.views), asked.series, asked.seeks
            self._watch()
        elif isinstance(asked, Restart):
            self.bridge.restart()
        elif isinstance(asked, Drive):
            self.bridge.send(asked.model_dump())
        else:
            self._last_id += 1
            self._asked[self._last_id] = (page, asked.id)
            self.bridge.send({**asked.model_dump(), "id": self._last_id})

    def receive(self, message: Message) -> None:
        """Take a message of the bridge and pass it on."""
        kind = message["kind"]
        if kind == "ready":
            message = {"kind": "bridge", "state": "ready", "distro": message["distro"]}
            self._asked.clear()
            self._watch()
        if message["kind"] in STATES:
            self._states[message["kind"]] = message
        if kind == "graph" and self.on_graph is not None:
            self.on_graph()
        if kind == "log":
            self._logs.extend(message["records"])
        if "id" in message:
            page, asked = self._asked.pop(message["id"], (None, 0))
            if page is not None:
                page.put({**message, "id": asked})
            return
        for page in self._pages:
            page.put(message)

    def _watch(self) -> None:
        views = {view for page in self._pages for view in page.views}
        plots = [page for page in self._pages if "plot" in page.views]
        series = {series for page in plots for series in page.series}
        if self.bridge is not None:
            self.bridge.send(
                {
                    "do": "watch",
                    "views": sorted(views),
                    "series": sorted(map(list, series)),
                    "seeks": any(page.seeks for page in plots),
                }
            )
