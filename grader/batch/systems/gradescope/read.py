"""Reads Gradescope's "Export Submissions": a folder for each submission, and their submitters.

`submission_metadata.yml` is written by Ruby: keys are symbols (`:submitters:`), and a time may be a
Rails object. A group has one folder and several submitters.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path

from grader.base.i18n.message import joined, say
from grader.base.shown import shown
from grader.batch.model import HandedIn, Student
from grader.batch.systems.gradescope.metadata import Record, instant, read_metadata
from grader.batch.systems.layout import FolderItem, Layout, Read, Reading
from grader.batch.systems.notes import printable
from grader.package.intake.reading import MEGABYTE, Unread, read_bytes

METADATA = "submission_metadata.yml"
NAMED = re.compile(r"submission_\d+")
LARGEST = 64 * MEGABYTE
UNKNOWN = say("not in submission_metadata.yml: its number was used as the student's name")
NO_FOLDER = say("it is in submission_metadata.yml, but its folder is not in the export")
GROUP = say("handed in together: each of them gets the verdict")
NO_METADATA = say("submission_metadata.yml is missing: no names and no times of submission")


def recognise(layout: Layout) -> bool:
    """Whether the metadata is there, or every folder is named like submission_123."""
    folders = [item.name for item in layout.items if item.kind == "folder"]
    named = bool(folders) and all(NAMED.fullmatch(name) for name in folders)
    return layout.has(METADATA, "file") or named


def read(layout: Layout, reading: Reading) -> Read:
    """Return each submission once for each submitter."""
    metadata = _metadata(layout, reading)
    found: list[HandedIn] = []
    rest = []
    there: set[str] = set()
    for item in layout.items:
        if item.name == METADATA:
            continue
        if not item.may_be_submission or not (item.name in metadata or NAMED.fullmatch(item.name)):
            rest.append(item)
            continue
        there.add(item.name)
        found += _submission(layout.path, item, metadata.get(item.name), bool(metadata))
    for name, record in metadata.items():
        if name not in there:
            gone = FolderItem(name, "folder", NO_FOLDER)
            found += _submission(layout.path, gone, record, known=True)
    return Read(_with_unique_keys(found), rest)


def _metadata(layout: Layout, reading: Reading) -> Mapping[str, Record]:
    if not layout.has(METADATA, "file"):
        reading.notes.add(NO_METADATA)
        return {}
    content = read_bytes(layout.path / METADATA, LARGEST)
    if isinstance(content, Unread):
        reading.notes.add(f"{METADATA} is not used: {content.reason}")
        return {}
    try:
        return read_metadata(content)
    except (ValueError, RecursionError) as error:
        why = shown(" ".join(str(error).split()))
        reading.notes.add(f"{METADATA} is not used because it is damaged: {why}")
        return {}


def _submission(
    path: Path, item: FolderItem, record: Record | None, known: bool
) -> Iterator[HandedIn]:
    place = path / item.name
    students = _submitters(item.name, record or {})
    notes: tuple[str, ...] = () if record is not None or not known else (UNKNOWN,)
    if len(students) > 1:
        notes += (joined(GROUP, ", ".join(student.name for student in students), by=": "),)
    earlier = _earlier(item.name, record or {})
    if earlier:
        notes += (
            say("the last of {count} attempts: the export has only this one", count=earlier + 1),
        )
    submitted = instant((record or {}).get(":created_at"))
    for student in students:
        yield HandedIn(student, place, submitted=submitted, notes=notes, problem=item.problem)


def _submitters(folder: str, record: Record) -> list[Student]:
    listed = record.get(":submitters")
    people = [one for one in listed if isinstance(one, dict)] if isinstance(listed, list) else []
    found = []
    for person in people:
        name, sid, email = (_text(person.get(key)) for key in (":name", ":sid", ":email"))
        key = (
            sid
            or email
            or (f"{printable(folder)} {name}" if len(people) > 1 else printable(folder))
        )
        found.append(Student(key=key, name=name or key, email=email, id_number=sid))
    return found or [Student(key=printable(folder), name=printable(folder))]


def _text(value: object) -> str:
    """Return a scalar as text: YAML reads a student's number as an integer."""
    return printable(str(value).strip()) if isinstance(value, str | int) else ""


def _earlier(folder: str, record: Record) -> int:
    """Return how many attempts there were before this one."""
    history = record.get(":history")
    own = folder.rpartition("_")[2]
    entries = [one for one in history if isinstance(one, dict)] if isinstance(history, list) else []
    return sum(str(one.get(":id", "")) != own for one in entries)


def _with_unique_keys(found: list[HandedIn]) -> list[HandedIn]:
    """Give different students with the same key (a mistyped number) one each, with a note."""
    people: dict[str, set[tuple[str, str]]] = {}
    for one in found:
        people.setdefault(one.student.key, set()).add((one.student.name, one.student.email))
    return [one if len(people[one.student.key]) == 1 else _with_own_key(one) for one in found]


def _with_own_key(one: HandedIn) -> HandedIn:
    student = one.student
    note = f"several students have the number {student.key}"
    key = f"{student.key} {student.email or student.name}"
    return replace(one, student=replace(student, key=key), notes=(*one.notes, note))
