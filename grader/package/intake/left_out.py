"""What intake leaves out, grouped by reason."""

from __future__ import annotations

from grader.base.i18n.message import joined, say
from grader.base.shown import shown

MOST_PLACES = 3


class LeftOut:
    """Reasons, each with its first few places: ten thousand files of one kind are one line."""

    def __init__(self) -> None:
        self._places: dict[str, list[str]] = {}
        self._counts: dict[str, int] = {}

    def add(self, reason: str, place: str) -> None:
        """Note that `place` was left out because of `reason`."""
        self._counts[reason] = self._counts.get(reason, 0) + 1
        places = self._places.setdefault(reason, [])
        if len(places) < MOST_PLACES:
            places.append(shown(place))

    def places(self, reason: str) -> list[str]:
        """Return the first places of one reason."""
        return list(self._places.get(reason, ()))

    def lines(self) -> list[str]:
        """Return one line for each reason."""
        found: list[str] = []
        for reason, places in self._places.items():
            more = self._counts[reason] - len(places)
            rest = say(" and {count} more", count=more) if more else ""
            found.append(joined(reason, ": ", ", ".join(places), rest, by=""))
        return found
