"""Attempts of students whose login or name, time and file are in the names of a download's items."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from datetime import datetime

from grader.base.i18n.message import joined, say
from grader.batch.model import HandedIn, Student
from grader.batch.systems.layout import FolderItem, Layout, Reading
from grader.batch.systems.notes import printable

ONLY_TEXT = say("the submission is only text: there is no file to mark")


@dataclass(frozen=True)
class NamedItem:
    """An item of a download: whose it is, when it was handed in, the student's name for it.

    `at` is in the site's own time zone, without an offset; `file` is "" for a folder, None for a text
    that the system wrote.
    """

    item: FolderItem
    student: Student
    at: datetime | None
    file: str | None


def attempts(items: Iterable[NamedItem], layout: Layout, reading: Reading) -> list[HandedIn]:
    """Return the attempts of each student in the order of their times."""
    by_student: dict[str, dict[datetime | None, list[NamedItem]]] = {}
    for one in items:
        by_student.setdefault(one.student.key, {}).setdefault(one.at, []).append(one)
    found = []
    for times in by_student.values():
        order = sorted(times, key=lambda at: (at is not None, at or datetime.min))
        for number, at in enumerate(order, start=1):
            found.append(_attempt(times[at], layout, reading, number))
    return found


def _attempt(parts: list[NamedItem], layout: Layout, reading: Reading, number: int) -> HandedIn:
    student, at = parts[0].student, parts[0].at
    files = [part for part in parts if part.file is not None]
    good = [part for part in files if not part.item.problem]
    names = tuple(part.item.name for part in files)
    if not good:
        first = files[0] if files else parts[0]
        path, problem = layout.path / first.item.name, first.item.problem or ONLY_TEXT
        return HandedIn(student, path, number, submitted=at, problem=problem, files=names)
    notes = tuple(
        joined(printable(part.item.name), part.item.problem, by=": ")
        for part in files
        if part.item.problem
    )
    if len(good) == 1 and good[0].item.kind != "file":
        path = layout.path / good[0].item.name
    else:
        path = reading.gather((layout.path / p.item.name, p.file or p.item.name) for p in good)
    return HandedIn(student, path, number, submitted=at, notes=notes, modes_kept=False, files=names)
