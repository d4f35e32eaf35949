"""Reads the instructor's worksheet and gradebook before the marking, and finds their columns."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from grader.base.errors import UsageError
from grader.batch.lowered import GradeChange, Lowered, changed, lowered
from grader.batch.model import ClassResult, Elsewhere, GradebookEntry, OnRoster, Student
from grader.batch.systems.known import sheet_forms
from grader.batch.systems.system import OpenSheet, System
from grader.course.assignment import Assignment

if TYPE_CHECKING:
    from grader.batch.roster import Roster

MOST_INPUT = 50_000_000  # bytes of one file


@dataclass(frozen=True)
class SheetOptions:
    """The instructor's files to fill in, by option, and the names of columns, by option."""

    files: Mapping[str, Path] = field(default_factory=dict)
    columns: Mapping[str, str] = field(default_factory=dict)
    show_hidden: bool = False


@dataclass(frozen=True)
class OpenSheets:
    """The files as read before the marking, by the name of the filled copy.

    `digest` is the hash of their contents.
    """

    by_output: Mapping[str, OpenSheet] = field(default_factory=dict)
    digest: str = ""

    @property
    def rosters(self) -> list[Roster]:
        """The rosters in the files, the more detailed one first."""
        return [sheet.roster for sheet in self.by_output.values()]

    @property
    def notes(self) -> list[str]:
        """Notes about the files for the instructor."""
        return [note for sheet in self.by_output.values() for note in sheet.notes]

    def elsewhere(self, students: Sequence[Student], system: System) -> dict[str, Elsewhere]:
        """Return the students whose submission or grade is in a file, by key."""
        found: dict[str, Elsewhere] = {}
        for sheet in self.by_output.values():
            found |= sheet.elsewhere(students, system)
        return found

    def lowered(self, result: ClassResult) -> list[Lowered]:
        """Return the grades in the files that would go down."""
        found = (lowered(*cell) for cell in self._existing(result))
        return [one for one in found if one is not None]

    def changed(self, result: ClassResult) -> list[GradeChange]:
        """Return the grades in the files that would be others."""
        found = (changed(*cell) for cell in self._existing(result))
        return [one for one in found if one is not None]

    def _existing(self, result: ClassResult) -> Iterator[tuple[GradebookEntry, str, str]]:
        for sheet in self.by_output.values():
            for entry, grade in sheet.existing(result):
                yield entry, grade, sheet.roster.name

    def covered(self, students: Sequence[Student], system: System) -> Iterator[OnRoster]:
        """Yield for each file how many of the students have a row in it."""
        for sheet in self.by_output.values():
            match = sheet.match(students, system)
            known = match.rows.keys() | match.unclear.keys()
            strangers = tuple(one.name for one in students if one.key not in known)
            roster = sheet.roster
            yield OnRoster(roster.name, len(students), strangers, len(roster.lines))


def open_sheets(options: SheetOptions, assignment: Assignment) -> OpenSheets:
    """Read the files and find their columns; raise UsageError if one cannot be filled in."""
    found: dict[str, OpenSheet] = {}
    digest = hashlib.sha256()
    for form in sheet_forms():
        path = options.files.get(form.option)
        content = b"" if path is None else _content(path)
        digest.update(hashlib.sha256(content).digest())
        if path is not None:
            columns = {name: options.columns.get(name, "") for name in form.columns}
            found[form.output] = form.read(content, columns, assignment)
    return OpenSheets(found, digest.hexdigest())


def _content(path: Path) -> bytes:
    try:
        with path.open("rb") as file:
            content = file.read(MOST_INPUT + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise UsageError(f"{path} cannot be read: {reason}") from None
    if len(content) > MOST_INPUT:
        raise UsageError(
            f"{path} is too large for a gradebook: more than {MOST_INPUT // 1_000_000} MB"
        )
    return content
