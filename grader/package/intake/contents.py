"""The files of one package, read with limits."""

from __future__ import annotations

from collections.abc import Iterator

from grader.base.i18n.message import say
from grader.package.intake.links import follow
from grader.package.intake.model import SourceFile
from grader.package.intake.place import Entry
from grader.package.intake.reading import MEGABYTE, Unread
from grader.package.intake.tree import LEADS_OUT, Tree

MOST_FILES = 5_000
"""How many files and folders a package may have."""
MOST_FILE_BYTES = 5 * MEGABYTE
MOST_BYTES = 50 * MEGABYTE
"""The total size of all files of a package."""
MOST_LINKS = 200
"""How many links of a package are read."""

COPIED = say("a link to a file outside the package: replaced by the file's content")
TOO_MANY_LINKS = say("left out, as there are more than {count} links", count=MOST_LINKS)


class TooLargeError(Exception):
    """A package beyond the limits; `reason` names the limit."""

    def __init__(self, reason: str) -> None:
        super().__init__(reason)
        self.reason = reason


def read_package(tree: Tree, root: str) -> tuple[SourceFile, ...]:
    """Return the files of the package in the folder `root`, sorted by path.

    Raises TooLargeError if the package as a whole is beyond the limits.
    """
    entries = tree.below(root)
    cut = root in tree.truncated or any(e.path in tree.truncated for e in entries.values())
    if cut or len(entries) > MOST_FILES:
        raise TooLargeError(
            say("it has more than {count} files and folders", count=f"{MOST_FILES:,}")
        )
    return tuple(_Reader(tree, entries).read())


class _Reader:
    def __init__(self, tree: Tree, entries: dict[str, Entry]) -> None:
        self._tree = tree
        self._entries = entries
        self._links = {path: e.target for path, e in entries.items() if e.kind == "link"}
        self._surplus = frozenset(list(self._links)[MOST_LINKS:])
        self._everywhere = tree.links()
        self._bytes = 0

    def read(self) -> Iterator[SourceFile]:
        for path, entry in self._entries.items():
            if entry.kind == "folder":
                yield SourceFile(path, "folder", entry.mode)
            elif entry.kind == "file":
                yield self._file(path, entry)
            elif path in self._surplus:
                self._tree.left_out.add(TOO_MANY_LINKS, entry.path)
            else:
                yield from self._link(path, entry)

    def _file(self, path: str, entry: Entry) -> SourceFile:
        found = self._tree.place.read(entry.path, MOST_FILE_BYTES)
        if isinstance(found, Unread):
            self._tree.left_out.add(
                say("without its content ({reason})", reason=found.reason), entry.path
            )
            return SourceFile(path, "file", entry.mode, unreadable=True, reason=found.reason)
        self._bytes += len(found)
        if self._bytes > MOST_BYTES:
            raise TooLargeError(
                say("its files have more than {size} MB in total", size=MOST_BYTES // MEGABYTE)
            )
        return SourceFile(path, "file", entry.mode, found)

    def _link(self, path: str, entry: Entry) -> Iterator[SourceFile]:
        """Keep a link that stays inside; replace one to another submitted file by that file."""
        way = follow(path, self._links)
        if way.loops or way.place is not None:
            yield SourceFile(path, "link", 0o777, target=entry.target)
            return
        place = follow(entry.path, self._everywhere).place
        goal = self._tree.entries.get(place) if place is not None else None
        if goal is None or goal.kind != "file":
            self._tree.left_out.add(LEADS_OUT, f"{entry.path} -> {entry.target}")
            self._tree.links_out.append(path)
            return
        self._tree.left_out.add(COPIED, entry.path)
        yield self._file(path, goal)
