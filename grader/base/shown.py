"""A student's text made safe for one line."""

from __future__ import annotations

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
