"""Finds a number that moves: what a plot begins with, before anybody has chosen a field."""

from __future__ import annotations

from typing import Any

from rclpy.node import Node

from lab.window.bridge.fields import message_type, number_at, numeric_fields
from lab.window.bridge.streams import Stream, stream

MOST_TOPICS = 40
MOST_FIELDS = 40  # of a topic
TIMES = ("sec", "nanosec")
"""The last parts of the fields of a time, which always moves."""
Series = tuple[str, str]
"""A topic and the path of a field."""


class Search:
    """Looks at the topics of the graph until a field has two different values."""

    def __init__(self, silent: Node) -> None:
        self._silent = silent
        self._streams: dict[str, tuple[list[str], Stream]] = {}
        self._first: dict[Series, float] = {}
        self.active = False
        """Whether somebody waits for the answer."""

    def begin(self) -> None:
        """Look from now on; what was seen before does not count."""
        self.active = True
        self._first.clear()

    def end(self) -> None:
        """End all subscriptions."""
        self.active = False
        for _, opened in self._streams.values():
            opened.close()
        self._streams.clear()

    def find(self, topics: list[dict[str, Any]]) -> None:
        """Begin and end with topics as they come and go."""
        wanted = [one for one in topics if one["publishers"] and not one["plumbing"]][:MOST_TOPICS]
        names = {one["name"] for one in wanted} if self.active else set()
        for name in set(self._streams) - names:
            self._streams.pop(name)[1].close()
        for one in wanted if self.active else ():
            if one["name"] not in self._streams:
                fields = _fields(one["publishers"][0]["type"])
                opened = stream(self._silent, one, depth=1) if fields else None
                if opened is not None:
                    self._streams[one["name"]] = (fields, opened)

    def look(self) -> Series | None:
        """Return a field that has moved; of several a fraction, such as the x of a pose."""
        moved: list[tuple[bool, Series]] = []
        for topic, (fields, opened) in self._streams.items():
            message = opened.newest()
            for field in fields if message is not None else ():
                number = number_at(message, field)
                if number is None:
                    continue
                first = self._first.setdefault((topic, field), number)
                if first != number:
                    whole = first.is_integer() and number.is_integer()
                    moved.append((whole, (topic, field)))
        if not moved:
            return None
        self.end()
        return min(moved, key=lambda one: one[0])[1]  # (the first of them)


def _fields(kind: str) -> list[str]:
    """Return the numeric fields of a type of message, without times."""
    found = message_type(kind)
    fields = [] if found is None else numeric_fields(found)
    return [each for each in fields if each.rpartition(".")[2] not in TIMES][:MOST_FIELDS]
