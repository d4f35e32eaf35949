"""The file names of the students' pages: safe on every file system, the same in each run."""

from __future__ import annotations

import hashlib
import re
from collections import Counter
from collections.abc import Iterable

DIGITS = 16
SAFE = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,59}")
UNSAFE = re.compile(r"[^A-Za-z0-9_-]+")
# names that Windows reserves for devices, with any extension (Microsoft, "Naming Files")
RESERVED = re.compile(r"con|prn|aux|nul|com\d|lpt\d", re.IGNORECASE)
DIGESTED = re.compile(rf".*-[0-9a-f]{{{DIGITS}}}")  # looks like a name made here


def page_names(keys: Iterable[str]) -> dict[str, str]:
    """Return the file name of each student's page by the student's key.

    A key that is not a safe name, or differs from another only in case, gets sixteen hex digits of
    its SHA-256, so that two students never share a page.
    """
    all_keys = list(keys)
    folded = Counter(key.casefold() for key in all_keys)
    return {key: _name(key, shared=folded[key.casefold()] > 1) for key in all_keys}


def _name(key: str, *, shared: bool) -> str:
    taken = shared or RESERVED.fullmatch(key) or DIGESTED.fullmatch(key)
    if SAFE.fullmatch(key) and not taken:
        return f"{key}.html"
    digest = hashlib.sha256(key.encode("utf-8", "surrogatepass")).hexdigest()[:DIGITS]
    start = UNSAFE.sub("_", key)[:40].strip("_-") or "student"
    return f"{start}-{digest}.html"
