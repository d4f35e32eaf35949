"""Reads Canvas' "Download Submissions": one flat folder with the attachments of all students.

By lib/content_zipper.rb: `<name>[_LATE]_<user id>_<attachment id>_<file>`, where the name is the
sortable one in lower case, reduced to letters, digits and `_`; anonymous ones are
`[LATE_]anon_<id>_<attachment id>_<file>`. Typed text or a link is an html file whose name ends with
`_text` or `_link`. A file that is uploaded again under the same name becomes `name-1.zip`.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from grader.base.i18n.message import joined, say
from grader.batch.model import HandedIn, Student
from grader.batch.systems.layout import FolderItem, Layout, Read, Reading
from grader.batch.systems.notes import printable

NAMED = re.compile(
    r"(?P<late1>LATE_)?(?:anon_(?P<anon>[A-Za-z0-9]+)|(?P<name>\w+?)(?P<late2>_LATE)?_(?P<user>\d+))"
    r"_(?:(?P<attachment>\d+)_(?P<file>.+)|(?P<typed>text|link)\.html)",
    re.DOTALL,
)
TWO_WAYS = re.compile(r"\w+?(?:_LATE)?(?:_\d+){3,}_", re.DOTALL)
AGAIN = re.compile(r"(?P<stem>.+)-\d{1,3}(?P<ending>(?:\.tar)?\.\w{1,8})", re.DOTALL)
NO_TIMES = say(
    "Canvas' download does not contain the times of submission (the times in the zip are those of "
    "the download), only whether a submission was late (LATE in the name)"
)
TYPED = say("left out: text or a link typed into Canvas")
ONLY_TYPED = say(
    "the submission is only text or a link typed into Canvas: there is no file to mark"
)
EARLIER = say("a file was handed in again under the same name: the newest one is the last attempt")
AMBIGUOUS = say("the student's number is not certain, because the name has digits around it")
RENAMED = say("renamed to the name without the number that Canvas added")


@dataclass(frozen=True)
class Attachment:
    """An attachment: `number` is its id (0 for typed text), `file` the student's name for it."""

    item: FolderItem
    number: int
    file: str
    late: bool

    @property
    def original(self) -> str:
        """The file's name without the number that Canvas adds when it is uploaded again."""
        match = AGAIN.fullmatch(self.file)
        return match["stem"] + match["ending"] if match else self.file


def recognise(layout: Layout) -> bool:
    """Whether at least half of the files, and as many as there are folders, have Canvas' names."""
    files = [item for item in layout.items if item.kind != "folder"]
    named = sum(NAMED.fullmatch(item.name) is not None for item in files)
    return named > 0 and 2 * named >= len(files) and named >= len(layout.items) - len(files)


def read(layout: Layout, reading: Reading) -> Read:
    """Return each student's attempts; an attempt may have several attachments."""
    parts: dict[str, list[Attachment]] = {}
    names: dict[str, str] = {}
    rest = []
    for item in layout.items:
        match = NAMED.fullmatch(item.name) if item.kind != "folder" else None
        if match is None:
            rest.append(item)
            continue
        key = match["user"] or f"anon_{match['anon']}"
        names.setdefault(key, match["name"] or key)
        late = bool(match["late1"] or match["late2"])
        number = int(match["attachment"] or 0)
        parts.setdefault(key, []).append(Attachment(item, number, match["file"] or "", late))
    reading.notes.add(NO_TIMES)
    found: list[HandedIn] = []
    for key, group in parts.items():
        found += _student(Student(key=key, name=printable(names[key])), layout, reading, group)
    return Read(found, rest)


def _student(
    student: Student, layout: Layout, reading: Reading, parts: list[Attachment]
) -> list[HandedIn]:
    late = any(part.late for part in parts)
    files = sorted((part for part in parts if part.file), key=lambda part: part.number)
    typed = [part.item for part in parts if not part.file]
    if not files:
        problem = typed[0].problem or ONLY_TYPED
        return [HandedIn(student, layout.path / typed[0].name, late=late, problem=problem)]
    notes = tuple(joined(TYPED, printable(item.name), by=": ") for item in typed)
    if any(TWO_WAYS.match(part.item.name) for part in files):
        notes += (AMBIGUOUS,)
    attempts = _attempts(files)
    if len(attempts) > 1:
        notes += (EARLIER,)
    return [
        _attempt(student, layout, reading, group, number=n, late=late, notes=notes)
        for n, group in enumerate(attempts, start=1)
    ]


def _attempts(files: list[Attachment]) -> list[list[Attachment]]:
    """Return the attempts: the newest files of all names are the last one."""
    newest = {part.original: part for part in files}
    last = [part for part in files if newest[part.original] is part]
    return [*([part] for part in files if newest[part.original] is not part), last]


def _attempt(
    student: Student,
    layout: Layout,
    reading: Reading,
    parts: list[Attachment],
    *,
    number: int,
    late: bool,
    notes: tuple[str, ...],
) -> HandedIn:
    good = [part for part in parts if not part.item.problem]
    bad = [part for part in parts if part.item.problem]
    notes = (
        *notes,
        *(joined(printable(part.item.name), part.item.problem, by=": ") for part in bad),
    )
    problem = "" if good else bad[0].item.problem
    path = layout.path / parts[0].item.name
    if good and (len(good) > 1 or good[0].item.kind != "archive"):
        files = [(layout.path / part.item.name, part.original) for part in good]
        path = reading.gather(files)
        renamed = [part.file for part in good if part.original != part.file]
        notes += tuple(joined(RENAMED, printable(name), by=": ") for name in renamed)
    elif good:
        path = layout.path / good[0].item.name
    return HandedIn(
        student,
        path,
        number,
        late=late,
        notes=notes,
        problem=problem,
        modes_kept=False,
        files=tuple(part.item.name for part in parts),
    )
