"""Reads Moodle's "Download all submissions": a folder or a file for each student or team.

By mod/assign/classes/downloader.php: `<name>_<id>_assignsubmission_<plugin>/…` ("Download
submissions in folders"), with a `_` at the end in older versions, or
`<name>_<id>_assignsubmission_<plugin>_<file>`. Underscores in the name become spaces, so the first
`_<id>_` is Moodle's own, whatever a student calls a file. `<id>` is the number in `Participant 123`
of the grading worksheet, or the team's; the default team has none.
"""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass, replace

from grader.base.i18n.message import joined, say
from grader.batch.model import HandedIn, Student
from grader.batch.systems.layout import FolderItem, Layout, Read, Reading
from grader.batch.systems.notes import printable

NAMED = re.compile(
    r"(?P<name>.*?)(?:_(?P<id>\d+))?_assignsubmission_(?P<plugin>[a-z]+)(?:_(?P<file>.*))?",
    re.DOTALL,
)
NO_TIMES = say(
    "Moodle's download does not contain the times of submission (the times in the zip are those of "
    "the download): they are read from the grading worksheet (--worksheet)"
)
ONLINE_TEXT = say("left out: text typed into Moodle")
ONLY_TEXT = say("the submission is only text typed into Moodle: there is no file to mark")
NO_ID = say("Moodle's number is not in the name: the name was used instead")
TWICE = say("more than one folder of this student, used as attempts in the order of their names")


@dataclass(frozen=True)
class Part:
    """One folder or file of a student; `file` is the student's name for it, "" for a folder."""

    item: FolderItem
    plugin: str
    file: str


def recognise(layout: Layout) -> bool:
    """Whether at least half of the possible submissions have Moodle's names."""
    named = sum(NAMED.fullmatch(item.name) is not None for item in layout.items)
    unnamed = sum(NAMED.fullmatch(item.name) is None for item in layout.submissions())
    return named > 0 and named >= unnamed


def read(layout: Layout, reading: Reading) -> Read:
    """Return each student's or team's submission."""
    parts: dict[tuple[str, str], list[Part]] = {}
    rest = []
    for item in layout.items:
        match = NAMED.fullmatch(item.name)
        if match is None:
            rest.append(item)
            continue
        name, number = printable(match["name"]), match["id"] or ""
        file = (match["file"] or "") if item.kind != "folder" else ""
        parts.setdefault((number or name, name), []).append(Part(item, match["plugin"], file))
    reading.notes.add(NO_TIMES)
    people = Counter(key for key, _ in parts)
    # blind marking: one name (`Participant` in the site's language) and many numbers
    blind = len(parts) > 1 and len({name for _, name in parts}) == 1
    found: list[HandedIn] = []
    for (key, name), group in parts.items():
        # two names with one number are not from one download of Moodle: they stay separate
        own = key if people[key] == 1 else f"{key} {name}"
        numbered = blind or name.casefold() == "participant"
        student = Student(key=own, name=f"{name} {key}" if numbered else name or key)
        found += _student(student, layout, reading, group)
    return Read(found, rest)


def _student(
    student: Student, layout: Layout, reading: Reading, parts: list[Part]
) -> list[HandedIn]:
    files = [part for part in parts if part.plugin == "file"]
    texts = [part for part in parts if part.plugin != "file"]
    if not files:
        path = layout.path / texts[0].item.name
        return [HandedIn(student, path, problem=texts[0].item.problem or ONLY_TEXT)]
    notes = tuple(joined(ONLINE_TEXT, printable(part.item.name), by=": ") for part in texts)
    if not student.key.isdecimal():
        notes += (NO_ID,)
    folders = [part for part in files if part.item.kind == "folder"]
    loose = [part for part in files if part.item.kind != "folder"]
    found = [
        HandedIn(
            student,
            layout.path / part.item.name,
            notes=notes,
            problem=part.item.problem,
            modes_kept=False,
        )
        for part in folders
    ]
    if loose:
        found.append(_loose_files(student, layout, reading, loose, notes))
    if len(found) == 1:
        return found
    return [
        replace(one, attempt=n, notes=(*one.notes, TWICE)) for n, one in enumerate(found, start=1)
    ]


def _loose_files(
    student: Student, layout: Layout, reading: Reading, parts: list[Part], notes: tuple[str, ...]
) -> HandedIn:
    good = [part for part in parts if not part.item.problem]
    problems = tuple(
        joined(printable(p.item.name), p.item.problem, by=": ") for p in parts if p.item.problem
    )
    if not good:
        path = layout.path / parts[0].item.name
        return HandedIn(student, path, notes=notes, problem=parts[0].item.problem)
    if len(good) == 1 and good[0].item.kind == "archive":
        path = layout.path / good[0].item.name
    else:
        path = reading.gather((layout.path / p.item.name, p.file) for p in good)
    return HandedIn(student, path, notes=(*notes, *problems), modes_kept=False)
