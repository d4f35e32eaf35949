"""Folders and archives without a system: each has the name of its student."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from grader.batch.model import HandedIn, Student
from grader.batch.systems.layout import FolderItem, Layout, Read, Reading
from grader.batch.systems.notes import printable
from grader.package.intake.archive_kind import without_ending


def recognise(layout: Layout) -> bool:
    """Whether there is any folder or archive."""
    return bool(layout.submissions())


def read(layout: Layout, reading: Reading) -> Read:
    """Return every folder and archive as a student's submission."""
    del reading
    files = [item for item in layout.items if not item.may_be_submission]
    return Read(read_items(layout.path, layout.items), rest=files)


def read_items(path: Path, items: Iterable[FolderItem]) -> list[HandedIn]:
    """Return folders and archives as students' submissions.

    `jane.zip` and `jane/` are attempts of one student, in this order, because an archive is
    unpacked after it was written. Several archives are in the order in which they were written.
    """
    by_key: dict[str, list[FolderItem]] = {}
    for item in items:
        if item.may_be_submission:
            stem = without_ending(item.name) if item.kind == "archive" else item.name
            by_key.setdefault(printable(stem), []).append(item)
    return [handed_in for key, group in by_key.items() for handed_in in _student(path, key, group)]


def _student(path: Path, key: str, items: list[FolderItem]) -> list[HandedIn]:
    student = Student(key=key, name=key)
    if len(items) == 1:
        return [HandedIn(student, path / items[0].name, problem=items[0].problem)]
    items = sorted(items, key=lambda item: (item.kind == "folder", _written(path / item.name)))
    names = ", ".join(printable(item.name) for item in items)
    note = f"several with this name, used as attempts of one student in this order: {names}"
    return [
        HandedIn(student, path / item.name, attempt=n, notes=(note,), problem=item.problem)
        for n, item in enumerate(items, start=1)
    ]


def _written(path: Path) -> int:
    try:
        return os.lstat(path).st_mtime_ns
    except OSError:
        return 0
