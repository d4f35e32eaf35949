"""A student's text made safe for one line, and what intake leaves out, grouped by reason."""

from __future__ import annotations

from grader.base.i18n.message import joined, say

SHOWN = 3
LONGEST = 120


def shown(text: str) -> str:
    """Return a student's text on one line: printable characters only, at most 120.

    (Bytes of a file name that are not UTF-8 appear as the surrogates U+DC80 to U+DCFF, PEP 383.)
    """
    plain = "".join(c if c.isprintable() else _escaped(ord(c)) for c in text[: LONGEST + 1])
    return plain if len(plain) <= LONGEST else plain[: LONGEST - 1] + "…"


def _escaped(code: int) -> str:
    if 0xDC80 <= code <= 0xDCFF:
        code -= 0xDC00
    return f"\\x{code:02x}" if code < 0x100 else f"\\u{code:04x}"


class LeftOut:
    """Reasons, each with its first few places: ten thousand files of one kind are one line."""

    def __init__(self) -> None:
        self._places: dict[str, list[str]] = {}
        self._counts: dict[str, int] = {}

    def add(self, reason: str, place: str) -> None:
        """Note that `place` was left out because of `reason`."""
        self._counts[reason] = self._counts.get(reason, 0) + 1
        places = self._places.setdefault(reason, [])
        if len(places) < SHOWN:
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
