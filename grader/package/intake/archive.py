"""An archive as a place: read once, kept in memory, never unpacked to the disk."""

# ruff: noqa: D102 - Place documents the methods

from __future__ import annotations

import io
import unicodedata
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from datetime import timezone
from typing import IO, Literal

from grader.base.errors import GraderError
from grader.base.i18n.message import Message, say
from grader.package.intake.archive_kind import HEAD, Kind, kind_of, without_ending
from grader.package.intake.archive_limits import Spent
from grader.package.intake.archive_member import Member, inside
from grader.package.intake.archive_problems import ArchiveError, corrupt, empty, unsafe, unsupported
from grader.package.intake.archive_tar import read_tar
from grader.package.intake.archive_zip import read_zip
from grader.package.intake.artefacts import FOLDERS
from grader.package.intake.place import Entry, not_a_folder, not_there
from grader.package.intake.reading import Unread, larger_than

TWICE = say("twice in the archive: the last one was used")
BELOW_FILE = say("left out, as it is below a name that is not a folder")
CASE_ONLY = say("names that differ only in case: not every system can distinguish them")
LONG_NAME = say("left out, as its name is too long")
HARD_LINK = say("left out, as it is a hard link to a file that is not before it in the archive")
SEVERAL_LOST = say("left out, as the archive has other files below that name")
GIT_MODES = (".git/config", ".git/index")  # they record the exec bits of a checkout


class Archive:
    """A zip or tar in memory; `name` is the archive's name without its ending."""

    def __init__(self, name: str, form: Literal["zip", "tar"]) -> None:
        self.name = name
        self._form = form
        self._entries: dict[str, Entry | None] = {".": Entry(".", "folder", 0o755)}
        self._children: dict[str, dict[str, None]] = {".": {}}
        self._data: dict[str, bytes] = {}
        self._modes: dict[str, int | None] = {}
        self._remarks: list[tuple[str, str]] = []

    # the methods of Place

    def origin(self, path: str) -> Literal["directory", "zip", "tar"]:
        del path
        return self._form

    def names(self, folder: str) -> Iterator[str]:
        if folder not in self._children:
            raise not_a_folder(folder) if folder in self._entries else not_there(folder)
        return iter(self._children[folder])

    def entry(self, path: str) -> Entry | None:
        if path not in self._entries:
            raise not_there(path)
        return self._entries[path]

    def read(self, path: str, limit: int) -> bytes | Unread:
        entry = self._entries.get(path)
        if entry is None or entry.kind != "file":
            return Unread(say("it is not a regular file"))
        if entry.size > limit:
            return larger_than(limit)
        return self._data.get(path, Unread(say("it was not kept")))

    def open(self, path: str) -> IO[bytes] | Unread:
        found = self.read(path, len(self._data.get(path, b"")))
        return found if isinstance(found, Unread) else io.BytesIO(found)

    def records_modes(self, path: str) -> bool:
        return self._modes.get(path) is not None

    def remarks(self) -> Iterable[tuple[str, str]]:
        return (*self._remarks, *((CASE_ONLY, ", ".join(pair)) for pair in self._case_only()))

    # filling it

    def add(self, member: Member, what: str, spent: Spent) -> None:
        """Add one member; ArchiveError for a name that leads out, or beyond the limits."""
        path = inside(member.name)
        if path is None:
            raise ArchiveError(unsafe(what, member.name))
        if path == ".":
            return
        if len(path) > spent.limits.name:
            self._remarks.append((LONG_NAME, path))
            return
        if member.remark:
            self._remarks.append((member.remark, path))
        if not self._make_parents(path, member):
            return
        if member.kind == "hard link":
            self._hard_link(path, member)
        elif member.kind == "file":
            size = self._keep(path, member, what, spent)
            entry = Entry(path, "file", member.mode or 0o644, size=size, modified=_seconds(member))
            self._put(path, entry, member.mode)
        elif member.kind == "link":
            self._put(path, Entry(path, "link", 0o777, target=member.target), member.mode)
        elif member.kind == "folder":
            self._put(path, Entry(path, "folder", 0o755), member.mode)
            self._children.setdefault(path, {})
        else:
            self._put(path, None, member.mode)

    def _make_parents(self, path: str, member: Member) -> bool:
        """Make the folders above a member; False if the member cannot be added there."""
        parts = path.split("/")
        for depth in range(1, len(parts)):
            above = "/".join(parts[:depth])
            if above not in self._entries:
                self._put(above, Entry(above, "folder", 0o755), None)
                self._children[above] = {}
            elif above not in self._children:
                self._remarks.append((BELOW_FILE, path))
                return False
        if path not in self._entries:
            return True
        if path in self._children:
            if member.kind != "folder":
                self._remarks.append((SEVERAL_LOST, path))
            return member.kind == "folder"
        self._remarks.append((TWICE, path))
        self._data.pop(path, None)
        return True

    def _put(self, path: str, entry: Entry | None, mode: int | None) -> None:
        self._entries[path] = entry
        self._modes[path] = mode
        folder, _, name = path.rpartition("/")
        self._children[folder or "."][name] = None

    def _hard_link(self, path: str, member: Member) -> None:
        """Add a hard link: one more name of a file that came before it."""
        goal = inside(member.target)
        entry = self._entries.get(goal) if goal is not None else None
        if goal is None or entry is None or entry.kind != "file":
            self._remarks.append((HARD_LINK, f"{path} -> {member.target}"))
            return
        if goal in self._data:
            self._data[path] = self._data[goal]
        self._put(path, Entry(path, "file", entry.mode, size=entry.size), self._modes[goal])

    def _keep(self, path: str, member: Member, what: str, spent: Spent) -> int:
        """Keep a file's bytes, if they may be needed; return its size."""
        of_a_tool = any(part in FOLDERS for part in path.split("/")[:-1])
        if (of_a_tool and not path.endswith(GIT_MODES)) or member.size > spent.limits.nested:
            return member.size
        held: list[bytes] = []
        size, most = 0, spent.limits.file
        for chunk in member.chunks():
            if not held and kind_of(chunk[:HEAD]) is not None:
                most = spent.limits.nested
            size += len(chunk)
            if size > most:
                return max(size, member.size)
            spent.hold(what, len(chunk))
            held.append(chunk)
        self._data[path] = b"".join(held)
        return size

    def _case_only(self) -> Iterator[list[str]]:
        same: dict[str, list[str]] = {}
        for path in self._entries:
            same.setdefault(unicodedata.normalize("NFC", path).casefold(), []).append(path)
        return (paths for paths in same.values() if len(paths) > 1)


def _seconds(member: Member) -> float:
    """Return a member's time in seconds since 1970; 0 if it is unknown.

    A zip's time has no zone: it is compared only with other times of the same archive.
    """
    if member.modified is None:
        return 0
    zone = member.modified.tzinfo or timezone.utc
    return member.modified.replace(tzinfo=zone).timestamp()


@contextmanager
def parsing(what: str) -> Iterator[None]:
    """Turn every exception of a parser of untrusted bytes into an ArchiveError."""
    try:
        yield
    except (ArchiveError, GraderError):
        raise
    except Exception as error:
        own = next((arg for arg in error.args if isinstance(arg, Message)), "")
        raise ArchiveError(corrupt(what, own or str(error) or type(error).__name__)) from None


def members_of(file: IO[bytes], kind: Kind, what: str, spent: Spent) -> Iterator[Member]:
    """Yield an archive's members; use it within `parsing`."""
    if kind.form == "zip":
        return read_zip(file, what, spent)
    if kind.form == "tar":
        return read_tar(file, kind.packing, what, spent)
    raise ArchiveError(unsupported(what, kind.words))


def read_archive(file: IO[bytes], kind: Kind, what: str, spent: Spent) -> Archive:
    """Read an archive into memory; ArchiveError if it is damaged or refused.

    `what` is its path for messages.
    """
    name = without_ending(what.rpartition("/")[2])
    archive = Archive(name, "zip" if kind.form == "zip" else "tar")
    found = False
    with parsing(what):
        for member in members_of(file, kind, what, spent):
            archive.add(member, what, spent)
            found = True
    if not found:
        raise ArchiveError(empty(what))
    return archive
