"""The name of a submission: that of its folder, made safe as a file name."""

from __future__ import annotations

import re
import unicodedata
from pathlib import Path

LONGEST = 80
LONGEST_BYTES = 200
"""Leaves room for a hash and our ending in the 255 bytes of a file system."""

WORKSPACE = re.compile(r"(?:[\w-]+[_-])?(?:ws|workspace)|src", re.IGNORECASE)


def submission_name(path: Path, package: str) -> str:
    """Return the name of a resolved path: the folder's, or that of the nearest parent which is
    not the package's name, `src`, or a workspace's (`ros2_ws`, `ws`, `workspace`).
    """
    for folder in (path, *path.parents):
        if folder.name and folder.name != package and not WORKSPACE.fullmatch(folder.name):
            return sanitise(folder.name)
    return sanitise(path.name)


def sanitise(name: str) -> str:
    """Return a name of letters and digits of any script, `.`, `_` and `-`, at most 80 long.

    It is never empty and never starts with `.` or `-`, since it is used as a file name.
    """
    normal = unicodedata.normalize("NFC", name)
    # a vowel sign belongs to its letter (Mn, Mc): without it the name is a different one
    plain = "".join(
        c if c.isalnum() or c in "._-" or unicodedata.category(c) in ("Mn", "Mc") else "_"
        for c in normal
    )
    cut = re.sub(r"_{2,}", "_", plain).lstrip(".-")[:LONGEST]
    cut = cut.encode()[:LONGEST_BYTES].decode(errors="ignore")
    return cut if cut.strip("_.-") else "submission"
