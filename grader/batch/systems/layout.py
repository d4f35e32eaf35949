"""The top level of a class folder: the name and kind of each item, without looking inside."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from grader.base.errors import UsageError
from grader.base.i18n.message import say
from grader.base.shown import shown
from grader.batch.model import HandedIn
from grader.batch.systems.notes import Notes, printable
from grader.package.intake.archive_kind import HEAD, is_named_archive, kind_of
from grader.package.intake.reading import Unread, open_file

ItemKind = Literal["folder", "archive", "file"]

MOST_NAMES = 100_000
HIDDEN = say("left out: hidden")
OF_SYSTEM = say("left out: files of the operating system, of a tool or of this grader")
NO_SUBMISSION = say("left out: neither a folder nor an archive")
IS_LINK = say("it is a link, and links are not followed: replace it with what it points to")
FILES = frozenset(
    [
        ".csv",
        ".html",
        ".txt",
        ".md",
        ".pdf",
        ".docx",
        ".xlsx",
        ".py",
        ".xml",
        ".cfg",
        ".toml",
        ".json",
        ".yml",
        ".yaml",
        ".rst",
        ".png",
    ]
)
TOOL_NAMES = frozenset(
    {
        *("__MACOSX", "__pycache__", "System Volume Information", "lost+found", "$RECYCLE.BIN"),
        *("reports", "node_modules", "Thumbs.db", "desktop.ini"),
    }
)


@dataclass(frozen=True)
class FolderItem:
    """An item in the class folder; `problem` says why it cannot be marked."""

    name: str
    kind: ItemKind
    problem: str = ""

    @property
    def may_be_submission(self) -> bool:
        """Whether its kind is that of a submission."""
        return self.kind != "file"


@dataclass(frozen=True)
class Layout:
    """A class folder; `left_out` are the names of no submission, by the reason."""

    path: Path
    items: tuple[FolderItem, ...]
    left_out: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    def has(self, name: str, kind: ItemKind) -> bool:
        """Return whether there is an item of that name and kind."""
        return any(item.name == name and item.kind == kind for item in self.items)

    def submissions(self) -> list[FolderItem]:
        """Return the items that may be submissions: folders and archives."""
        return [item for item in self.items if item.may_be_submission]


@dataclass(frozen=True)
class Reading:
    """What a system's reader gets besides the layout.

    `gather` copies files of one student, each under a given name, into one folder.
    """

    notes: Notes
    gather: Callable[[Iterable[tuple[Path, str]]], Path]


@dataclass(frozen=True)
class Read:
    """What a system's reader found in a layout; `rest` are the items that it did not recognise."""

    handed_in: list[HandedIn]
    rest: list[FolderItem] = field(default_factory=list)


def look_at(path: Path, *, lost: Mapping[str, str], without: Iterable[Path] = ()) -> Layout:
    """Return the layout of a class folder; raise UsageError if it cannot be read.

    `lost` are names that could not be unpacked, with the reason; `without` are folders of the
    grader.
    """
    own = {place.name for place in without if place.parent == path}
    items = [
        FolderItem(name, _kind_by_name(name), why)
        for name, why in lost.items()
        if _why_left_out(name, is_folder=_kind_by_name(name) == "folder") is None
    ]
    left_out: dict[str, list[str]] = {}
    try:
        with os.scandir(path) as entries:
            for entry in entries:
                if entry.name in own:
                    continue
                found = _item(entry)
                if isinstance(found, FolderItem):
                    items.append(found)
                else:
                    left_out.setdefault(found, []).append(entry.name)
                if len(items) > MOST_NAMES:
                    raise UsageError(f"{shown(str(path))} holds more than {MOST_NAMES:,} names")
    except OSError as error:
        raise UsageError(f"{shown(str(path))} cannot be read: {error.strerror}") from None
    items.sort(key=lambda item: os.fsencode(item.name))
    return Layout(path, tuple(items), {why: tuple(sorted(n)) for why, n in left_out.items()})


def _item(entry: os.DirEntry[str]) -> FolderItem | str:
    """Return an item, or the reason why the name is left out."""
    name = entry.name
    left_out = _why_left_out(name, is_folder=entry.is_dir(follow_symlinks=False))
    if left_out is not None:
        return left_out
    if entry.is_symlink():
        # (its target is not examined, so its name decides)
        return FolderItem(name, _kind_by_name(name), IS_LINK)
    if entry.is_dir(follow_symlinks=False):
        return FolderItem(name, "folder")
    if entry.is_file(follow_symlinks=False):
        return FolderItem(name, "archive" if _is_archive(entry) else "file")
    return NO_SUBMISSION


def _why_left_out(name: str, *, is_folder: bool) -> str | None:
    is_backup = name.endswith("~") and not is_folder  # editors make backups of files only
    if name in TOOL_NAMES or is_backup:
        return OF_SYSTEM
    return HIDDEN if name.startswith(".") else None


def _kind_by_name(name: str) -> ItemKind:
    if is_named_archive(name):
        return "archive"
    return "file" if Path(name).suffix.lower() in FILES else "folder"


def _is_archive(entry: os.DirEntry[str]) -> bool:
    """Whether a file is named like an archive, or has no extension and is one."""
    if is_named_archive(entry.name) or "." in entry.name:
        return is_named_archive(entry.name)
    opened = open_file(Path(entry.path))
    if isinstance(opened, Unread):
        return False
    with opened as file:
        return kind_of(file.read(HEAD)) is not None


def seen(layout: Layout) -> str:
    """Return in words what is in a layout, for error messages."""
    counts = {
        "folder": sum(item.kind == "folder" for item in layout.items),
        "archive": sum(item.kind == "archive" for item in layout.items),
        "other file": sum(item.kind == "file" for item in layout.items),
    }
    parts = [f"{n} {what}{'s' if n != 1 else ''}" for what, n in counts.items() if n]
    names = ", ".join(shown(printable(item.name)) for item in layout.items[:3])
    more = f" and {len(layout.items) - 3} more" if len(layout.items) > 3 else ""
    return f"{' and '.join(parts)} ({names}{more})" if parts else "nothing"
