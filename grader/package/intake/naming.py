"""The name under which a submission is reported: its folder's, made fit for a file name."""

from __future__ import annotations

import re
import unicodedata
from pathlib import Path

LONGEST = 80
LONGEST_BYTES = 200
"""What a file system leaves of 255 bytes after a hash and an ending of ours."""

WORKSPACE = re.compile(r"(?:[\w-]+[_-])?(?:ws|workspace)|src", re.IGNORECASE)


def submission_name(path: Path, package: str) -> str:
    """Return the name of a resolved path: the folder's, or that of the nearest parent which says
    more than the package's name, `src`, or a workspace's (`ros2_ws`, `ws`, `workspace`).
    """
    for folder in (path, *path.parents):
        if folder.name and folder.name != package and not WORKSPACE.fullmatch(folder.name):
            return sanitise(folder.name)
    return sanitise(path.name)


def sanitise(name: str) -> str:
    """Return a name with letters and digits of any script, `.`, `_` and `-`, at most 80 long.

    Never empty, and never with `.` or `-` in front: it is used as a file name.
    """
    normal = unicodedata.normalize("NFC", name)
    # a vowel sign belongs to its letter (Mn, Mc): without it the name is another one
    plain = "".join(
        c if c.isalnum() or c in "._-" or unicodedata.category(c) in ("Mn", "Mc") else "_"
        for c in normal
    )
    cut = re.sub(r"_{2,}", "_", plain).lstrip(".-")[:LONGEST]
    cut = cut.encode()[:LONGEST_BYTES].decode(errors="ignore")
    return cut if cut.strip("_.-") else "submission"
