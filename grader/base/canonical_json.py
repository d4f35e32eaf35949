"""JSON whose bytes are equal whenever the values are, so that they can be hashed and signed."""

from __future__ import annotations

import json
import re

SURROGATES = re.compile("[\ud800-\udfff]")  # they stand for bytes that are not UTF-8


def canonical_json(value: object) -> bytes:
    """Return a JSON value as UTF-8 with sorted keys, without white space, and with a line end.

    Bytes of a name that are not UTF-8 are escaped. Raises ValueError for NaN and infinity.
    """
    text = json.dumps(
        value, ensure_ascii=False, allow_nan=False, sort_keys=True, separators=(",", ":")
    )
    return SURROGATES.sub(_escaped, f"{text}\n").encode()


def _escaped(found: re.Match[str]) -> str:
    """Return a backslash (itself escaped in JSON) and the byte in hexadecimal digits."""
    return f"\\\\x{ord(found[0]) & 0xFF:02x}"
