"""Where a symbolic link leads, told from the text of the links alone: nothing is followed."""

from __future__ import annotations

from collections.abc import Mapping

MOST_FOLLOWED = 40
"""How many links one path may go through, as in Linux (path_resolution(7))."""


def follow(path: str, links: Mapping[str, str]) -> str | None:
    """Return the place that `path` means, relative to the same root as the links' paths.

    None if it leads above the root, to an absolute path, or round in a loop. The place need not
    exist.
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
                return None
            at.pop()
            continue
        at.append(part)
        target = links.get("/".join(at))
        if target is None:
            continue
        followed += 1
        if followed > MOST_FOLLOWED or target.startswith("/"):
            return None
        at.pop()
        to_go.extend(target.split("/")[::-1])
    return "/".join(at)


def is_loop(path: str, links: Mapping[str, str]) -> bool:
    """Whether following `path` comes back to itself without ever leaving the root."""
    seen: set[str] = set()
    while path in links and path not in seen:
        seen.add(path)
        target = links[path]
        if target.startswith("/"):
            return False
        without = {other: to for other, to in links.items() if other not in seen}
        folder = path.rpartition("/")[0]
        place = follow(f"{folder}/{target}", without)
        if place is None:
            return False
        path = place
    return path in seen
