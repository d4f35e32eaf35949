"""Reads the folder in Drive that Google Classroom keeps for an assignment: `<First Last> - <file name>`.

The layout was seen in other programs, not in Google's own documents. A name is all that tells who a student
is, and no time is in it: the instructor confirms the join, and gives times.csv.
"""

from __future__ import annotations

import re

from grader.base.i18n.message import say
from grader.batch.model import Student
from grader.batch.systems.layout import Layout, Read, Reading
from grader.batch.systems.named_attempts import NamedItem, attempts
from grader.batch.systems.notes import printable

# (a file's own name may have " - " too)
NAMED = re.compile(r"(?P<name>[^\d\W][^\d]*?) - (?P<file>.+\.\w+)", re.DOTALL)
NAMES = 2  # at the least: a single file may have its own dash
NO_TIMES = say("Google Classroom's folder has no times of submission: give them in times.csv")


def recognise(layout: Layout) -> bool:
    """Whether at least half of the items are files with the names of two or more students."""
    matches = [NAMED.fullmatch(item.name) for item in layout.items if item.kind != "folder"]
    names = {match["name"] for match in matches if match is not None}
    named = sum(match is not None for match in matches)
    return len(names) >= NAMES and 2 * named >= len(layout.items)


def read(layout: Layout, reading: Reading) -> Read:
    """Return each student's files together."""
    found, rest = [], []
    for item in layout.items:
        match = NAMED.fullmatch(item.name) if item.kind != "folder" else None
        if match is None:
            rest.append(item)
            continue
        name = printable(match["name"])
        found.append(NamedItem(item, Student(key=name, name=name), None, match["file"]))
    reading.notes.add(NO_TIMES)
    return Read(attempts(found, layout, reading), rest)
