"""Where a symbolic link leads, computed from the links' targets alone: nothing is followed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

MOST_FOLLOWED = 40
"""How many links one path may go through, as in Linux (path_resolution(7))."""


@dataclass(frozen=True)
class Way:
    """Where a path ends: a `place` below the root (may be missing); None: it `loops` or leaves."""

    place: str | None
    loops: bool = False


def follow(path: str, links: Mapping[str, str]) -> Way:
    """Return where `path` leads; the links' own paths are relative to the same root.

    A path leads out if it passes above the root, or through an absolute target.
    """
    to_go = path.split("/")[::-1]
    at: list[str] = []
    followed = 0
    while to_go:
        part = to_go.pop()
        if part in ("", "."):
            continue
        if part == "..":
            if not at:
                return Way(None)
            at.pop()
            continue
        at.append(part)
        target = links.get("/".join(at))
        if target is None:
            continue
        followed += 1
        if target.startswith("/"):
            return Way(None)
        if followed > MOST_FOLLOWED:
            return Way(None, loops=True)
        at.pop()
        to_go.extend(target.split("/")[::-1])
    return Way("/".join(at))
