"""Notes for the instructor, and file names as printable text."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable

from grader.base.i18n.message import joined, some_of
from grader.base.shown import shown

MOST_SHOWN = 50
DIRECTION = "\u202a\u202b\u202d\u202e\u2066\u2067\u2068\u2069"


def printable(name: str) -> str:
    """Return a file name as printable text; different names stay different.

    Control characters, direction overrides, bytes that are not UTF-8 (PEP 383) and backslashes are
    escaped.
    """
    if name.isascii() and name.isprintable() and "\\" not in name:
        return name
    return "".join(_escaped(c) for c in name)


def _escaped(character: str) -> str:
    category = unicodedata.category(character)
    if character == "\\":
        return "\\\\"
    if category in ("Cc", "Cs", "Zl", "Zp", "Cn") or character in DIRECTION:
        return (
            f"\\u{ord(character):04x}" if ord(character) < 0x10000 else f"\\U{ord(character):08x}"
        )
    return character


class Notes:
    """Notes about a class for the instructor, each one once; names are listed by reason."""

    def __init__(self) -> None:
        self._lines: dict[str, list[str] | None] = {}

    def add(self, line: str) -> None:
        """Add a sentence."""
        self._lines.setdefault(line, None)

    def add_names(self, reason: str, names: Iterable[str]) -> None:
        """Add file names (as on the disk) to the note of a reason."""
        known = self._lines.setdefault(reason, [])
        if known is not None:
            known.extend(shown(printable(name)) for name in names)

    def lines(self) -> tuple[str, ...]:
        """Return all notes, one line each."""
        return tuple(_line(reason, names) for reason, names in self._lines.items())


def _line(reason: str, names: list[str] | None) -> str:
    if names is None:
        return reason
    return joined(reason, some_of(names, MOST_SHOWN), by=": ")
