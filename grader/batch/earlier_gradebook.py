"""The gradebook of an earlier run: its grades must not get lost when it is written again.

A row is a student's by its key, or else by its id number, email or user name. A name counts only if
nobody else has it, neither in the class nor in the gradebook, and if nothing else differs.
"""

from __future__ import annotations

import csv
import io
from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.i18n.message import say
from grader.base.plain_text import one_line
from grader.batch import cells
from grader.batch.decoded import decoded
from grader.batch.lowered import GradeChange, Lowered, as_number, changed, lowered
from grader.batch.match import possible_names, written_names
from grader.batch.model import ClassResult, Elsewhere, Student
from grader.package.intake.reading import MEGABYTE, Unread, read_bytes

NAME = "the existing gradebook"
LARGEST = 100 * MEGABYTE
UNSHARED = ("email", "username", "id_number")  # columns that are unique to a student
NO_VERDICT = ("missing", "pending")  # states whose final grade is not from a verdict


@dataclass(frozen=True)
class EarlierGradebook:
    """The gradebook's rows with a final grade, by the student's key.

    `names` counts the names of all rows, in every way to write them, those without a grade included.
    """

    rows: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    names: Mapping[str, int] = field(default_factory=dict)

    def elsewhere(
        self, students: Sequence[Student], class_: Sequence[Student]
    ) -> dict[str, Elsewhere]:
        """Return the grades that some students of a class already have, by key."""
        shared = _shared_names(class_)
        found = {}
        for student in students:
            key = self._key(student, shared)
            if key:
                points = self.rows[key]["final"]
                found[student.key] = Elsewhere(
                    say("the existing gradebook has {points} points", points=points),
                    as_number(points),
                )
        return found

    def _key(self, student: Student, shared: Collection[str]) -> str:
        """Return the key of a student's row, "" if there is not exactly one; `shared`: names."""
        own_key = cells.text(student.key)
        if own_key in self.rows and (student.key != student.name or not _is_in(student, shared)):
            return own_key
        own = _identifiers(_fields(student))
        fit = [key for key, row in self.rows.items() if own & _identifiers(row)]
        if not fit and not _is_in(student, shared):
            fit = self._by_name(student, own)
        return fit[0] if len(fit) == 1 else ""

    def _by_name(self, student: Student, own: Collection[tuple[str, str]]) -> list[str]:
        names = set(written_names(student))
        if any(self.names.get(name, 0) > 1 for name in names):
            return []
        fit = {key for name in names for key in self._keys_by_name.get(name, ())}
        columns = {column for column, _ in own}
        # the same name with another email address is somebody else
        return [
            key
            for key in fit
            if not columns & {column for column, _ in _identifiers(self.rows[key])}
        ]

    @cached_property
    def _keys_by_name(self) -> Mapping[str, set[str]]:
        found: dict[str, set[str]] = {}
        for key, row in self.rows.items():
            for name in set(possible_names(Student(key, row.get("name", "")))):
                found.setdefault(name, set()).add(key)
        return found

    def changed(self, result: ClassResult) -> list[GradeChange]:
        """Return the grades that differ from those in the gradebook, in the order of the class."""
        keys = {cells.text(entry.student.key): entry for entry in result.entries}
        found = (
            changed(entry, self.rows[key]["final"], NAME)
            for key, entry in keys.items()
            if key in self.rows
        )
        return [one for one in found if one is not None]

    def lowered(self, result: ClassResult) -> list[Lowered]:
        """Return the grades that would go down or be removed.

        A submission that is no longer certain to be a student's does not count: nobody had its
        grade for sure.
        """
        entries = {cells.text(entry.student.key): entry for entry in result.entries}
        found = [
            lowered(entry, self.rows[key]["final"], NAME)
            for key, entry in entries.items()
            if key in self.rows and entry.status not in ("pending", "unclear")
        ]
        students = [entry.student for entry in result.entries]
        shared = _shared_names(students)
        known = {self._key(student, shared) for student in students}
        gone = [
            Lowered(key, one_line(row.get("name") or key, most=60), NAME, row["final"], "")
            for key, row in self.rows.items()
            if key not in entries and key not in known
        ]
        return [*(one for one in found if one is not None), *gone]


def read_earlier_gradebook(path: Path) -> EarlierGradebook:
    """Read the gradebook of an earlier run; it is empty if there is no readable one."""
    content = read_bytes(path, LARGEST)
    if isinstance(content, Unread):
        return EarlierGradebook()
    try:
        text = decoded(content, str(path)).text
        rows = list(csv.DictReader(io.StringIO(text, newline="")))
    except (UsageError, csv.Error):
        return EarlierGradebook()
    return EarlierGradebook(
        names=Counter(
            name for row in rows for name in set(possible_names(Student("", row.get("name") or "")))
        ),
        rows={
            row["key"]: {name: value for name, value in row.items() if isinstance(value, str)}
            for row in rows
            if row.get("key") and row.get("final") and row.get("status") not in NO_VERDICT
        },
    )


def _shared_names(students: Sequence[Student]) -> frozenset[str]:
    """Return the names that more than one student has, in every way to write them."""
    counts = Counter(name for one in students for name in set(possible_names(one)))
    return frozenset(name for name, count in counts.items() if count > 1)


def _is_in(student: Student, names: Collection[str]) -> bool:
    return any(name in names for name in written_names(student))


def _fields(student: Student) -> dict[str, str]:
    return {name: cells.text(str(getattr(student, name))) for name in UNSHARED}


def _identifiers(row: Mapping[str, str]) -> set[tuple[str, str]]:
    """Return the pairs of column and value that identify a student under another key."""
    return {(name, row[name].casefold()) for name in UNSHARED if row.get(name)}
