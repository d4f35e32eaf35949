"""Which of several packages with the same name is meant, and which are copies of it."""

from __future__ import annotations

import re
from collections.abc import Sequence

from grader.package.intake.model import Candidate
from grader.package.intake.reading import Unread
from grader.package.intake.tree import Tree, join

MOST_SETUP_BYTES = 64_000
WORDS = (
    *("old", "older", "backup", "bak", "copy", "kopie", "copie", "orig", "original", "save"),
    *("saved", "tmp", "temp", "before", "previous", "prev", "archive", "trash", "unused"),
    *("복사본", "사본", "백업", "이전"),
)
COPY = re.compile(
    rf"(?:.*[^a-z])?(?:{'|'.join(WORDS)})[0-9]{{0,4}}(?:[^a-z].*)?|.*(?:\(\d{{1,4}}\)|~)", re.DOTALL
)


def original(
    tree: Tree, candidates: Sequence[Candidate], *, package: str, node_file: str
) -> Candidate | None:
    """Return the candidate that is meant, None if that is not clear.

    It is the only one, the only one that is not named like a copy, or one that has all that the
    others have and more.
    """
    if len(candidates) == 1:
        return candidates[0]
    named = [c for c in candidates if not _is_named_like_a_copy(tree, c, candidates, package)]
    if len(named) == 1:
        return named[0]
    parts = {c.path: _parts(tree, c, package, node_file) for c in candidates}
    best = max(candidates, key=lambda c: len(parts[c.path]))
    others = [parts[c.path] for c in candidates if c is not best]
    return best if all(other < parts[best.path] for other in others) else None


def _is_named_like_a_copy(
    tree: Tree, candidate: Candidate, candidates: Sequence[Candidate], package: str
) -> bool:
    """Whether a folder's name, or that of a folder around it that not all share, names a copy."""
    folders = _folders(tree, candidate)
    shared = set.intersection(*(set(enumerate(_folders(tree, c))) for c in candidates))
    own = [name for place in enumerate(folders) if place not in shared for name in place[1:]]
    return any(name != package and COPY.fullmatch(name.lower()) for name in own)


def _folders(tree: Tree, candidate: Candidate) -> list[str]:
    return [tree.place.name] if candidate.path == "." else candidate.path.split("/")


def _parts(tree: Tree, candidate: Candidate, package: str, node_file: str) -> set[str]:
    """Return the parts of a package that a candidate has and that are not empty."""
    paths = ("package.xml", "setup.py", "setup.cfg", f"{package}/__init__.py")
    found = {path for path in paths if tree.file(join(candidate.path, path)) is not None}
    if tree.file(join(candidate.path, f"resource/{package}")) is not None:
        found.add("resource")
    node = tree.file(join(candidate.path, f"{package}/{node_file}"))
    if node is not None and node.size:
        found.add("node")
    setup = tree.file(join(candidate.path, "setup.py"))
    data = tree.place.read(setup.path, MOST_SETUP_BYTES) if setup is not None else b""
    if not isinstance(data, Unread) and f"{node_file.removesuffix('.py')}:".encode() in data:
        found.add("entry point")
    return found
