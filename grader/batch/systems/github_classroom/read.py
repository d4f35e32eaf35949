"""Reads GitHub Classroom's clones of student repositories, named `<assignment>-<username>`."""

from __future__ import annotations

from itertools import takewhile
from pathlib import Path

from grader.base.i18n.message import say
from grader.batch.model import HandedIn, Student
from grader.batch.systems.layout import FolderItem, Layout, Read, Reading
from grader.batch.systems.notes import printable

SUBMISSIONS = "-submissions"  # appended to the assignment's name by `gh classroom clone`
NO_TIMES = say(
    "a clone does not contain the time of submission (the student's own computer sets the time of "
    "a commit): only the CSV of Classroom's 'Download grades' has it, given as --roster"
)


def recognise(layout: Layout) -> bool:
    """Whether at least half of the folders are repositories with a common prefix."""
    repositories = _repositories(layout)
    folders = [item for item in layout.items if item.kind == "folder"]
    return 2 * len(repositories) >= max(1, len(folders)) and bool(_prefix(layout, repositories))


def read(layout: Layout, reading: Reading) -> Read:
    """Return each repository; no time in a clone can be trusted as the time of submission."""
    repositories = _repositories(layout)
    prefix = _prefix(layout, repositories)
    found = []
    rest = []
    for item in layout.items:
        if item not in repositories:
            rest.append(item)
            continue
        username = printable(item.name).removeprefix(prefix)
        student = Student(key=printable(item.name), name=username, username=username)
        found.append(HandedIn(student, layout.path / item.name))
    reading.notes.add(NO_TIMES)
    return Read(found, rest)


def _repositories(layout: Layout) -> list[FolderItem]:
    folders = [item for item in layout.items if item.kind == "folder" and not item.problem]
    return [item for item in folders if _is_folder(layout.path / item.name / ".git")]


def _is_folder(path: Path) -> bool:
    return path.is_dir() and not path.is_symlink()


def _prefix(layout: Layout, repositories: list[FolderItem]) -> str:
    """Return the common prefix of all names up to a `-`, "" if there is none.

    The folder of `gh classroom clone` has the assignment's name; otherwise two or more names are
    compared.
    """
    names = [printable(item.name) for item in repositories]
    prefix = f"{printable(layout.path.name).removesuffix(SUBMISSIONS)}-"
    if layout.path.name.endswith(SUBMISSIONS) and any(name.startswith(prefix) for name in names):
        return prefix
    if len(names) < 2:
        return ""
    first, last = min(names), max(names)  # all names between these two share their prefix
    same = sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(first, last)))
    return first[: first.rfind("-", 0, same) + 1]
