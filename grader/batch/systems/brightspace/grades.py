"""Brightspace's grades export: fills the points of one item into the instructor's own file.

`OrgDefinedId,Username,Last Name,First Name,Email,<item> Points Grade <Numeric MaxPoints:100>,
End-of-Line Indicator`, with `#` before identifiers (seen in other programs' adapters, not in
Brightspace's own documents). Every byte but the filled cells stays as it is.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from grader.base.errors import UsageError
from grader.base.plain_text import one_line
from grader.batch import cells
from grader.batch.lowered import is_without_verdict
from grader.batch.match import Match, match_more, rules_for_people
from grader.batch.model import ClassResult, Comment, Elsewhere, GradebookEntry, Student
from grader.batch.roster import Roster, roster_of
from grader.batch.sheet import Filled, Sheet, folded_header
from grader.batch.systems.system import System
from grader.batch.words import has_grade

NAME = "Brightspace's grades export"
POINTS = re.compile(r"(?P<item>.+?) points grade(?: <.*?maxpoints:\s*(?P<most>[\d.]+).*>)?", re.I)
IDENTIFIERS = ("orgdefinedid", "username")


@dataclass(frozen=True)
class GradesExport:
    """The file: the column that is filled, its maximum (None: not said), and its students."""

    sheet: Sheet
    column: int
    most: float | None
    roster: Roster

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes about the file for the instructor."""
        return (self.sheet.note,) if self.sheet.note else ()

    def match(self, students: Sequence[Student], system: System) -> Match:
        """Return the roster line of each student, by key."""
        found = Match()
        match_more(found, rules_for_people(system, students, self.roster), students, self.roster)
        return found

    def elsewhere(self, students: Sequence[Student], system: System) -> dict[str, Elsewhere]:
        """Return the students who have a grade in the file, by key."""
        rows = self.match(students, system).rows
        return {
            key: Elsewhere(has_grade("Brightspace", grade))
            for key, row in rows.items()
            if (grade := self.sheet.value(self.roster.lines[row].row, self.column))
        }

    def existing(self, result: ClassResult) -> list[tuple[GradebookEntry, str]]:
        """Return the entries that are filled in, each with the cell of its grade as it is."""
        rows = self._filled_in(result)
        return [(entry, self.sheet.value(row, self.column)) for row, entry in rows]

    def filled(self, result: ClassResult, comment: Comment) -> Filled:
        """Return the file with the points of every student with a final grade."""
        del comment  # the export has no column for it
        changes = {}
        for row, entry in self._filled_in(result):
            if self.most is not None and entry.final is not None and entry.final > self.most:
                raise UsageError(
                    f"more points than {NAME} allows: {_who(entry)}: {cells.number(entry.final)}",
                    remedy="Set the item's maximum in Brightspace to "
                    f"{cells.number(result.max_score)}, then export the grades again.",
                )
            changes[row, self.column] = cells.number(entry.final)
        match = self.match([entry.student for entry in result.entries], result.system)
        missing = [e for e in result.entries if e.student.key not in match.rows and e.report]
        warnings = [f"{_who(entry)} is not in {NAME}: nothing was filled in" for entry in missing]
        warnings += [
            f"{_who(entry)} was found in {NAME} by name only"
            for entry in result.entries
            if entry.student.key in match.by_name
        ]
        return Filled(self.sheet.filled(changes), tuple(warnings))

    def _filled_in(self, result: ClassResult) -> Iterator[tuple[int, GradebookEntry]]:
        match = self.match([entry.student for entry in result.entries], result.system)
        for entry in result.entries:
            index = match.rows.get(entry.student.key)
            if index is None or entry.final is None:
                continue
            row = self.roster.lines[index].row
            has_grade = bool(self.sheet.value(row, self.column))
            if is_without_verdict(entry) and (has_grade or entry.keeps_grade):
                continue
            yield row, entry


def read_grades(content: bytes, *, column: str, names: Sequence[str]) -> GradesExport:
    """Read the export; `names` are the assignment's, `column` the one that the instructor named.

    Raises UsageError if it is no export of Brightspace, or if the column is not clear.
    """
    sheet = Sheet(content, name=NAME)
    header = [folded_header(name) for name in sheet.header]
    if IDENTIFIERS[0] not in header and IDENTIFIERS[1] not in header:
        raise UsageError(
            f"{NAME} has no column OrgDefinedId or Username",
            remedy="In Brightspace: Grades, Enter Grades, Export, with 'Both' as key field.",
        )
    index = _column(sheet, column, names)
    found = POINTS.fullmatch(sheet.header[index])
    most = float(found["most"]) if found is not None and found["most"] else None
    return GradesExport(sheet, index, most, _roster(sheet, header))


def _column(sheet: Sheet, column: str, names: Sequence[str]) -> int:
    items = {
        n: match["item"] for n, name in enumerate(sheet.header) if (match := POINTS.fullmatch(name))
    }
    wanted = [column] if column else list(names)
    fit = [
        n
        for n, name in enumerate(sheet.header)
        if any(word.casefold() in (name.casefold(), items.get(n, "").casefold()) for word in wanted)
    ]
    if not fit and not column and len(items) == 1:
        fit = list(items)
    if len(fit) == 1:
        return fit[0]
    listed = one_line(", ".join(items.values()) or ", ".join(sheet.header), most=600)
    raise UsageError(
        f"it is not clear which column of {NAME} is filled: {listed}",
        remedy="Name it: --brightspace-column 'Lesson 1' (make: BRIGHTSPACE_COLUMN=).",
    )


def _roster(sheet: Sheet, header: Sequence[str]) -> Roster:
    """Return the students, without the `#` before their identifiers."""
    changes = {
        (row, n): sheet.value(row, n).removeprefix("#")
        for n, name in enumerate(header)
        if name in IDENTIFIERS
        for row in range(1, len(sheet.rows))
        if sheet.has_cell(row, n)
    }
    return roster_of(Sheet(sheet.filled(changes), name=NAME), NAME)


def _who(entry: GradebookEntry) -> str:
    return one_line(entry.student.name or entry.student.key, most=100)
