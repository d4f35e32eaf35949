"""A package with folders around it that nobody needs, such as those of the whole workspace."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable, Sequence

from grader.base.i18n.message import Message, say
from grader.base.shown import shown
from grader.package.intake.archive_kind import is_named_archive
from grader.package.intake.tree import parent

DOWNLOADED = re.compile(r".{1,100}-(?:main|master)")
"""The folder that GitHub puts around the files of a repository that is downloaded as an archive."""


def folders_around(
    roots: Sequence[str], made: Iterable[str], *, given: str, package: str
) -> Message | None:
    """Return the advice on which folders to hand in; None if nothing needless is around them.

    `roots` are the folders of the package and of those beside it, `made` the folders build and
    install, `given` is the name of the folder that was handed in, "" for an archive.
    """
    start = f"{roots[0]}/"
    places = [roots[0], *(path for path in roots[1:] if not path.startswith(start))]
    if not _is_deep(_top(places), given, package):
        return None
    built = any(parent(path) != roots[0] and not path.startswith(start) for path in made)
    place = ", ".join(shown("/".join(_unpacked(path))) for path in places)
    if len(places) > 1:
        return _of_several(place, built=built)
    if built:
        return say(
            "A whole workspace was handed in, and {place} in it was marked. Next time, hand in only "
            "{place}. Leave out build, install and log: colcon makes them again.",
            place=place,
        )
    return say(
        "There are folders around the package, and {place} in them was marked. Next time, hand in "
        "only {place}, without the folders around it.",
        place=place,
    )


def _of_several(place: str, *, built: bool) -> Message:
    """Return the same for several packages; `place` has their folders."""
    if built:
        return say(
            "A whole workspace was handed in, and {place} in it were marked. Next time, hand in one "
            "folder with these packages only. Leave out build, install and log: colcon makes them "
            "again.",
            place=place,
        )
    return say(
        "There are several folders around the packages, and {place} in them were marked. Next time, "
        "hand in one folder with these packages only.",
        place=place,
    )


def _top(places: Sequence[str]) -> str:
    """Return the folder that is handed in: that of the package, or the one that holds several."""
    return places[0] if len(places) == 1 else posixpath.commonpath(places) or "."


def _is_deep(root: str, given: str, package: str) -> bool:
    """Whether the package is not directly in what was handed in.

    One folder around it is usual: that of the student. But a folder with the package's name is
    meant to be the package.
    """
    parts = [] if root == "." else _unpacked(root)
    packed = len(parts) <= root.count("/")
    if len(parts) > 1 and DOWNLOADED.fullmatch(parts[0]):
        parts = parts[1:]
    return len(parts) > 1 or (len(parts) == 1 and not packed and given == package)


def _unpacked(path: str) -> list[str]:
    """Return the parts of a path in the innermost archive that it leads into."""
    parts = path.split("/")
    archives = [at for at, part in enumerate(parts) if is_named_archive(part)]
    return parts[archives[-1] + 1 :] if archives else parts
