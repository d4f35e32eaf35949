"""Names of files as texts that can be shown, stored and compared, and the notes that name them."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable

from grader.base.shown import shown

MOST_SHOWN = 50
TURNING = "\u202a\u202b\u202d\u202e\u2066\u2067\u2068\u2069"


def printable(name: str) -> str:
    """Return a file's name as text that every program takes; no two names become the same.

    Controls, direction overrides and bytes that are not UTF-8 (PEP 383) are spelled out, and so is
    the backslash that does it.
    """
    if name.isascii() and name.isprintable() and "\\" not in name:
        return name
    return "".join(_spelled(c) for c in name)


def _spelled(character: str) -> str:
    category = unicodedata.category(character)
    if character == "\\":
        return "\\\\"
    if category in ("Cc", "Cs", "Zl", "Zp", "Cn") or character in TURNING:
        return (
            f"\\u{ord(character):04x}" if ord(character) < 0x10000 else f"\\U{ord(character):08x}"
        )
    return character


class Notes:
    """What an instructor should know of a class, each thing once; names under their reason."""

    def __init__(self) -> None:
        self._lines: dict[str, list[str] | None] = {}

    def say(self, line: str) -> None:
        """Note a sentence."""
        self._lines.setdefault(line, None)

    def name(self, reason: str, names: Iterable[str]) -> None:
        """Note names of files (as they are on the disk) under a reason."""
        known = self._lines.setdefault(reason, [])
        if known is not None:
            known.extend(shown(printable(name)) for name in names)

    def lines(self) -> tuple[str, ...]:
        """Return all notes, one line each."""
        return tuple(_line(reason, names) for reason, names in self._lines.items())


def _line(reason: str, names: list[str] | None) -> str:
    if names is None:
        return reason
    more = f" and {len(names) - MOST_SHOWN} more" if len(names) > MOST_SHOWN else ""
    return f"{reason}: {', '.join(names[:MOST_SHOWN])}{more}"
