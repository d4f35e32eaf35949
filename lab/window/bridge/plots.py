"""The numbers that plots show: fields of topics over time."""

from __future__ import annotations

from typing import Any

from rclpy.node import Node

from lab.window.bridge.fields import number_at
from lab.window.bridge.streams import Stream, stream

MOST_SERIES = 12
Series = tuple[str, str]
"""A topic and the path of a field."""


class Plots:
    """The streams of the topics of which a plot shows a field."""

    def __init__(self, silent: Node) -> None:
        self._silent = silent
        self._wanted: list[Series] = []
        self._streams: dict[str, tuple[str, Stream]] = {}

    def want(self, series: list[Series]) -> None:
        """Show these series and no others."""
        self._wanted = series[:MOST_SERIES]

    def find(self, topics: list[dict[str, Any]]) -> None:
        """Begin and end streams as topics come, change and go."""
        names = {topic for topic, _ in self._wanted}
        found = {entry["name"]: entry for entry in topics if entry["name"] in names}
        for name, (offer, opened) in list(self._streams.items()):
            if name not in found or offer != _offer(found[name]):
                opened.close()
                del self._streams[name]
        for name, entry in found.items():
            if name not in self._streams:
                opened_now = stream(self._silent, entry)
                if opened_now is not None:
                    self._streams[name] = (_offer(entry), opened_now)

    @property
    def active(self) -> bool:
        """Whether a series is shown."""
        return bool(self._streams)

    def look(self) -> list[list[Any]]:
        """Return topic, field, times and values of what has arrived; times are s since the epoch."""
        found = []
        for topic, (_, opened) in self._streams.items():
            messages = list(opened.take())
            for wanted, field in self._wanted:
                points = [
                    (round(at, 4), number)
                    for message, at in (messages if wanted == topic else ())
                    if (number := number_at(message, field)) is not None
                ]
                if points:
                    times, values = zip(*points)
                    found.append([topic, field, list(times), list(values)])
        return found


def _offer(entry: dict[str, Any]) -> str:
    return repr([(end["type"], sorted(end["qos"].items())) for end in entry["publishers"]])
