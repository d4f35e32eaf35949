"""The gradebook that an earlier run wrote: what is in it is not lost when it is written again."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.plain_text import one_line
from grader.batch import cells
from grader.batch.decoded import decoded
from grader.batch.lowered import Lowered, as_number, lowered
from grader.batch.model import ClassResult, Elsewhere, Student
from grader.package.intake.reading import MEGABYTE, Unread, read_bytes

NAME = "the gradebook that is there already"
LARGEST = 100 * MEGABYTE
UNSHARED = ("email", "username", "id_number")  # columns of what nobody shares
IDENTITY = ("name", *UNSHARED)
NO_VERDICT = ("missing", "pending")  # a final grade beside these is no verdict's


@dataclass(frozen=True)
class EarlierGradebook:
    """The rows with a final grade, by the student's key."""

    rows: Mapping[str, Mapping[str, str]] = field(default_factory=dict)

    def elsewhere(self, student: Student) -> Elsewhere | None:
        """Return the grade that a student has already, None if there is none."""
        row = self.rows.get(cells.text(student.key)) or self._same(student)
        if row is None:
            return None
        reason = f"{NAME} has {row['final']} points"
        return Elsewhere(reason, as_number(row["final"]))

    def _same(self, student: Student) -> Mapping[str, str] | None:
        """Return the one row with something of a student's that nobody shares, None if not one."""
        own = _marks(_fields(student))
        for names in (UNSHARED, ("name",)):
            own_marks = {mark for mark in own if mark[0] in names}
            fit = [row for row in self.rows.values() if own_marks & _marks(row)]
            if fit:
                return fit[0] if len(fit) == 1 else None
        return None

    def lowered(self, result: ClassResult) -> list[Lowered]:
        """Return the grades that would go down or away."""
        entries = {cells.text(entry.student.key): entry for entry in result.entries}
        found = [
            lowered(entry, self.rows[key]["final"], NAME)
            for key, entry in entries.items()
            if key in self.rows and entry.status != "pending"
        ]
        known = {mark for entry in result.entries for mark in _marks(_fields(entry.student))}
        gone = [
            Lowered(key, one_line(row.get("name") or key, most=60), NAME, row["final"], "")
            for key, row in self.rows.items()
            if key not in entries and not known & _marks(row)
        ]
        return [*(one for one in found if one is not None), *gone]


def read_earlier_gradebook(path: Path) -> EarlierGradebook:
    """Read the gradebook of an earlier run; nothing if there is none, or none that can be read."""
    content = read_bytes(path, LARGEST)
    if isinstance(content, Unread):
        return EarlierGradebook()
    try:
        text = decoded(content, str(path)).text
        rows = list(csv.DictReader(io.StringIO(text, newline="")))
    except (UsageError, csv.Error):
        return EarlierGradebook()
    return EarlierGradebook(
        {
            row["key"]: {name: value for name, value in row.items() if isinstance(value, str)}
            for row in rows
            if row.get("key") and row.get("final") and row.get("status") not in NO_VERDICT
        }
    )


def _fields(student: Student) -> dict[str, str]:
    return {name: cells.text(str(getattr(student, name))) for name in IDENTITY}


def _marks(row: Mapping[str, str]) -> set[tuple[str, str]]:
    """Return what tells that a student of another key is the same one."""
    return {(name, row[name].casefold()) for name in IDENTITY if row.get(name)}
