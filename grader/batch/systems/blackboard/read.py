"""Reads Blackboard's "Assignment File Download".

`<assignment>_<login>_attempt_<YYYY-MM-DD-HH-MM-SS>_<file>`, and a text for each attempt without the
last part (seen in adapters of other programs, not in Blackboard's own documents). Both assignment and
login may have underscores: the text says `Name: First Last (login)`; without it the login is what
follows the last underscore, which the instructor confirms in the join.
"""

from __future__ import annotations

import re
from datetime import datetime

from grader.batch.model import Student
from grader.batch.systems.layout import Layout, Read, Reading
from grader.batch.systems.named_attempts import NamedItem, attempts
from grader.batch.systems.notes import printable
from grader.package.intake.reading import MEGABYTE, Unread, read_bytes

NAMED = re.compile(
    r"(?P<head>.+)_attempt_(?P<at>\d{4}(?:-\d\d){5})(?:\.txt|_(?P<file>.+))", re.DOTALL
)
NAME = re.compile(r"^\s*Name\s*:\s*(?P<name>.*?)\s*\((?P<login>[^()\s]+)\)\s*$", re.MULTILINE)
TIME = "%Y-%m-%d-%H-%M-%S"


def recognise(layout: Layout) -> bool:
    """Whether at least half of the items have Blackboard's names."""
    named = sum(NAMED.fullmatch(item.name) is not None for item in layout.items)
    return named > 0 and 2 * named >= len(layout.items)


def read(layout: Layout, reading: Reading) -> Read:
    """Return each student's attempts, with the times that are in the names."""
    matches = [(item, NAMED.fullmatch(item.name)) for item in layout.items]
    known: dict[str, Student] = {}
    for item, match in matches:
        if match is not None and match["file"] is None:
            student = _said(layout, item.name, match["head"])
            if student is not None:
                known[match["head"]] = student
    found = []
    for item, match in matches:
        if match is None:
            continue
        student = known.get(match["head"]) or _by_name(match["head"])
        file = match["file"]
        found.append(NamedItem(item, student, _time(match["at"]), file))
    rest = [item for item, match in matches if match is None]
    return Read(attempts(found, layout, reading), rest)


def _said(layout: Layout, name: str, head: str) -> Student | None:
    """Return the student that the text of an attempt names, if the file's name agrees."""
    content = read_bytes(layout.path / name, MEGABYTE)
    if isinstance(content, Unread):
        return None
    match = NAME.search(content.decode("utf-8-sig", errors="replace"))
    if match is None or not head.endswith(f"_{match['login']}"):
        return None
    login = printable(match["login"])
    return Student(key=login, name=printable(match["name"]), username=login)


def _by_name(head: str) -> Student:
    login = printable(head.rpartition("_")[2] or head)
    return Student(key=login, name=login, username=login)


def _time(text: str) -> datetime | None:
    try:
        return datetime.strptime(text, TIME)
    except ValueError:
        return None
