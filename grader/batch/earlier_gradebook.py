"""The gradebook of an earlier run: its grades must not get lost when it is written again."""

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

NAME = "the existing gradebook"
LARGEST = 100 * MEGABYTE
UNSHARED = ("email", "username", "id_number")  # columns that are unique to a student
IDENTITY = ("name", *UNSHARED)
NO_VERDICT = ("missing", "pending")  # states whose final grade is not from a verdict


@dataclass(frozen=True)
class EarlierGradebook:
    """The gradebook's rows with a final grade, by the student's key."""

    rows: Mapping[str, Mapping[str, str]] = field(default_factory=dict)

    def elsewhere(self, student: Student) -> Elsewhere | None:
        """Return the grade that a student already has, None if there is none."""
        row = self.rows.get(cells.text(student.key)) or self._same(student)
        if row is None:
            return None
        reason = f"{NAME} has {row['final']} points"
        return Elsewhere(reason, as_number(row["final"]))

    def _same(self, student: Student) -> Mapping[str, str] | None:
        """Return the only row with a student's unique data (else name), None if it is not one."""
        all_own = _identifiers(_fields(student))
        for names in (UNSHARED, ("name",)):
            own = {identifier for identifier in all_own if identifier[0] in names}
            fit = [row for row in self.rows.values() if own & _identifiers(row)]
            if fit:
                return fit[0] if len(fit) == 1 else None
        return None

    def lowered(self, result: ClassResult) -> list[Lowered]:
        """Return the grades that would go down or be removed."""
        entries = {cells.text(entry.student.key): entry for entry in result.entries}
        found = [
            lowered(entry, self.rows[key]["final"], NAME)
            for key, entry in entries.items()
            if key in self.rows and entry.status != "pending"
        ]
        known = {one for entry in result.entries for one in _identifiers(_fields(entry.student))}
        gone = [
            Lowered(key, one_line(row.get("name") or key, most=60), NAME, row["final"], "")
            for key, row in self.rows.items()
            if key not in entries and not known & _identifiers(row)
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
        {
            row["key"]: {name: value for name, value in row.items() if isinstance(value, str)}
            for row in rows
            if row.get("key") and row.get("final") and row.get("status") not in NO_VERDICT
        }
    )


def _fields(student: Student) -> dict[str, str]:
    return {name: cells.text(str(getattr(student, name))) for name in IDENTITY}


def _identifiers(row: Mapping[str, str]) -> set[tuple[str, str]]:
    """Return the pairs of column and value that identify a student under another key."""
    return {(name, row[name].casefold()) for name in IDENTITY if row.get(name)}
