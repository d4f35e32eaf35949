"""Reads Brightspace's download of all submissions.

`<user>-<item> - <First Last> - <Nov 20, 2026 1130 PM>`, a folder or with ` - <file>` at the end (seen
in adapters of other programs, not in Brightspace's own documents). The user's number there is not the
OrgDefinedId of the grades, so students are joined by name, which the instructor confirms in the join.
"""

from __future__ import annotations

import re
from datetime import datetime

from grader.batch.model import Student
from grader.batch.systems.layout import Layout, Read, Reading
from grader.batch.systems.named_attempts import NamedItem, attempts
from grader.batch.systems.notes import printable

NAMED = re.compile(
    r"(?P<user>\d+)-\d+ - (?P<name>.+?) - (?P<at>[A-Za-z]{3,9} \d{1,2}, \d{4} \d{3,4} ?[AP]M)"
    r"(?: - (?P<file>.+))?",
    re.DOTALL,
)
TIMES = ("%b %d, %Y %I%M %p", "%B %d, %Y %I%M %p")


def recognise(layout: Layout) -> bool:
    """Whether at least half of the items have Brightspace's names."""
    named = sum(NAMED.fullmatch(item.name) is not None for item in layout.items)
    return named > 0 and 2 * named >= len(layout.items)


def read(layout: Layout, reading: Reading) -> Read:
    """Return each student's attempts, with the times that are in the names."""
    found, rest = [], []
    for item in layout.items:
        match = NAMED.fullmatch(item.name)
        if match is None:
            rest.append(item)
            continue
        student = Student(key=f"d2l-{match['user']}", name=printable(match["name"]))
        file = (match["file"] or "") if item.kind != "folder" else ""
        found.append(NamedItem(item, student, _time(match["at"]), file))
    return Read(attempts(found, layout, reading), rest)


def _time(text: str) -> datetime | None:
    words = text.split()
    clock, half = (words[3], words[4]) if len(words) == 5 else (words[3][:-2], words[3][-2:])
    plain = f"{words[0]} {words[1]} {words[2]} {clock.zfill(4)} {half}"
    for form in TIMES:
        try:
            return datetime.strptime(plain, form)
        except ValueError:
            continue
    return None
