"""A student's text made safe: on one line, or as a name that JSON and SQLite can store."""

from __future__ import annotations

from pathlib import Path

LONGEST = 120


def utf8_name(name: str | Path) -> str:
    """Return a file's name, whole, as text that can be stored: bytes that are not UTF-8 escaped."""
    return str(name).encode("utf-8", "surrogateescape").decode("utf-8", "backslashreplace")


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
