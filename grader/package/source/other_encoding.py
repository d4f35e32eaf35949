"""In which encoding a file is that is not UTF-8: an editor must open it in that one first."""

from __future__ import annotations

import codecs
import re

KOREAN, DECLARED, OTHER = "korean", "declared", ""
DECLARATION = re.compile(rb"[ \t\f]*#.*?coding[:=][ \t]*(?P<name>[-\w.]+)")
MOST_BYTES = 100_000
ENOUGH = 0.9
"""The part of the characters that are not ASCII that must be Hangul: other text has few."""


def kind_of_encoding(found: bytes) -> str:
    """Return `korean` for CP949 (or EUC-KR), "" for another 8-bit encoding.

    `declared` is for valid UTF-8 that declares another encoding, `saved` for what an editor opens
    rightly by itself (UTF-16 with a mark), and for UTF-8 with some other bytes in it.
    """
    if declaration(found) is not None:
        return DECLARED
    if found.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)) or _decoded(found, "utf-8"):
        return "saved"
    text = _decoded(found, "cp949") or ""
    other = [sign for sign in text if not sign.isascii()]
    hangul = [
        sign for sign in other if "\uac00" <= sign <= "\ud7a3" or "\u3131" <= sign <= "\u318e"
    ]
    if other and len(hangul) >= ENOUGH * len(other):
        return KOREAN
    # (two bytes of another encoding can look like one character of UTF-8, three hardly ever)
    kept = found.decode("utf-8", "ignore")
    return "saved" if any(sign >= "\u0800" for sign in kept) else OTHER


def declaration(found: bytes) -> tuple[int, str] | None:
    """Return the line with which UTF-8 declares another encoding, and that encoding's name."""
    if _decoded(found, "utf-8") is None:
        return None
    for number, line in enumerate(found.split(b"\n")[:2], 1):
        match = DECLARATION.match(line)
        if match is not None:
            name = match["name"].decode("ascii", "replace")
            is_utf8 = name.lower().replace("_", "-") in ("utf-8", "utf8", "utf-8-sig", "u8")
            return None if is_utf8 else (number, name)
    return None


def _decoded(found: bytes, encoding: str) -> str | None:
    try:
        return found[:MOST_BYTES].decode(encoding)
    except UnicodeDecodeError:
        return None
