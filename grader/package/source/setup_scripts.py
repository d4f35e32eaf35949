"""The argument scripts of setup(), if it names one file of the package and nothing else."""

from __future__ import annotations

import re


def scripts_line(setup: bytes, path: str) -> tuple[int, str] | None:
    """Return the line that is only scripts=[…] with this file, and its code; None if there is none."""
    text = setup.decode("utf-8", "replace")
    named = re.compile(rf"\s*(scripts\s*=\s*\[\s*(['\"]){re.escape(path)}\2\s*,?\s*\]\s*,)\s*")
    for number, line in enumerate(text.split("\n"), 1):
        match = named.fullmatch(line)
        if match is not None:
            return number, match[1]
    return None
