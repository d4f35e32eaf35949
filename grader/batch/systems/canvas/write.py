"""Canvas' gradebook CSV: fills in one column of the instructor's export, or writes a new file.

By Canvas' lib/gradebook_importer.rb: the first columns identify the student (`Student`, `ID`, SIS
ids, `Section`), then come columns `Title (assignment id)`. In a row `    Points Possible`, `(read
only)` marks columns that the import ignores; there may be a row with `Manual Posting`. `EX` is an
excused student, `N/A` one who does not have the assignment.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from grader.base.errors import UsageError
from grader.base.plain_text import one_line
from grader.batch import cells
from grader.batch.lowered import NONE, as_number, is_without_verdict
from grader.batch.match import Match, MatchRule, match_more, rules_for_people
from grader.batch.model import ClassResult, Comment, Elsewhere, GradebookEntry, Student
from grader.batch.roster import Roster, roster_of
from grader.batch.sheet import Filled, Sheet
from grader.batch.systems.system import System
from grader.batch.words import has_grade

NAME = "the Canvas gradebook"
REMEDY = "In Canvas: Grades, Export, Export Entire Gradebook."
OWN = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")
POSSIBLE = "    Points Possible"
TITLE_AND_ID = re.compile(r"(?P<title>.*?)\s*\((?P<id>\d+)\)")
KEPT = ("EX", "N/A")
READ_ONLY = re.compile(r"read\s+only")
# columns that Canvas computes; the name of a group may precede, that of a period may follow
COMPUTED = re.compile(r"(Current|Final) (Score|Points|Grade)|Override (Score|Grade|Status)")


@dataclass(frozen=True)
class CanvasGradebook:
    """A gradebook: the column to fill in, and the student of each row."""

    sheet: Sheet
    column: int
    roster: Roster
    notes: tuple[str, ...] = ()

    def match(self, students: Sequence[Student], system: System) -> Match:
        """Return the roster line of each student, by key."""
        found = Match()
        rules = list(rules_for_people(system, students, self.roster))
        sure = [rule for rule in rules if not rule.by_name]
        rules = [*sure, MatchRule(_email, _login), *(rule for rule in rules if rule.by_name)]
        match_more(found, rules, students, self.roster)
        return found

    def elsewhere(self, students: Sequence[Student], system: System) -> dict[str, Elsewhere]:
        """Return the students with a grade in Canvas, or excused, by key."""
        found = {}
        for key, index in self.match(students, system).rows.items():
            cell = self._cell(self.roster.lines[index].row)
            if cell not in NONE:
                found[key] = Elsewhere(has_grade("Canvas", cell))
        return found

    def existing(self, result: ClassResult) -> list[tuple[GradebookEntry, str]]:
        """Return the entries that are filled in, each with the cell of its grade as it is."""
        return [
            (entry, self._cell(row))
            for row, entry in self._filled_in(result, self._match(result))
            if self._cell(row).upper() not in KEPT
        ]

    def filled(self, result: ClassResult, comment: Comment) -> Filled:
        """Return the instructor's export with the assignment's column filled in.

        A cell does not change if the student has no final grade, if it has EX or N/A, or if it has
        a grade and the student has no submission here.
        """
        del comment  # Canvas imports none
        match = self._match(result)
        warnings = [*_points_warning(self.sheet, self.column, result), *_warnings(result, match)]
        comma = self.sheet.decimal_comma(self.column)
        changes: dict[tuple[int, int], str] = {}
        for row, entry in self._filled_in(result, match):
            if self._cell(row).upper() in KEPT:
                warnings.append(f"{_who(entry)} has {self._cell(row)} in Canvas: kept")
            else:
                changes[row, self.column] = cells.number(entry.final, comma=comma)
        return Filled(self.sheet.filled(changes), tuple(warnings))

    def _match(self, result: ClassResult) -> Match:
        return self.match([entry.student for entry in result.entries], result.system)

    def _cell(self, row: int) -> str:
        return self.sheet.value(row, self.column)

    def _filled_in(self, result: ClassResult, match: Match) -> Iterator[tuple[int, GradebookEntry]]:
        """Yield the rows that get a grade, with their entries."""
        for entry in result.entries:
            index = match.rows.get(entry.student.key)
            if index is None or entry.final is None:
                continue
            row = self.roster.lines[index].row
            held = self._cell(row) not in NONE or entry.keeps_grade
            if not (is_without_verdict(entry) and held):
                yield row, entry


def read_gradebook(
    content: bytes, *, column: str = "", names: Iterable[str] = ()
) -> CanvasGradebook:
    """Read a gradebook and find the assignment's column.

    `column` is its header, title or number (default: the first of `names` that exactly one column
    has). Raises UsageError if the file is not a gradebook or the column is not found.
    """
    sheet = Sheet(content, name=NAME)
    index = _column(sheet, [column] if column else [name for name in names if name])
    roster = roster_of(sheet, NAME)
    for line in roster.lines:
        if not sheet.has_cell(line.row, index):
            who = one_line(line.student.name, most=100)
            raise UsageError(f"{NAME} is damaged: the row of {who} is too short", remedy=REMEDY)
    return CanvasGradebook(sheet, index, roster, (sheet.note,) if sheet.note else ())


def new_gradebook(result: ClassResult, *, title: str = "") -> bytes:
    """Return a gradebook with one new column; Canvas creates the assignment on import.

    Students without a final grade are left out: if an assignment of this title exists, Canvas
    removes the grade for an empty cell (`no_change_to_value?`).
    """
    out = io.StringIO()
    table = csv.writer(out)
    table.writerow([*OWN, cells.text(title or result.title or result.assignment)])
    table.writerow([POSSIBLE, *[""] * (len(OWN) - 1), cells.number(result.max_score)])
    for entry in result.entries:
        if entry.final is None or entry.keeps_grade:
            continue
        student = entry.student
        number = student.key if result.system.name == "canvas" else ""
        who = (student.name, number, student.id_number, student.username, student.section)
        table.writerow([*(cells.text(value) for value in who), cells.number(entry.final)])
    return out.getvalue().encode()


def _column(sheet: Sheet, wanted: Sequence[str]) -> int:
    header = sheet.header
    _need_gradebook(header)
    first = header.index("Section") + 1
    open_ = [i for i in range(first, len(header)) if not COMPUTED.search(header[i])]
    for name in wanted:
        fit = [index for index in open_ if _is_called(header[index], name)]
        if len(fit) == 1:
            if READ_ONLY.search(_possible(sheet, fit[0])):
                raise UsageError(f"{NAME}: the column '{header[fit[0]]}' is read only")
            return fit[0]
    listed = one_line(", ".join(f"'{header[index]}'" for index in open_), most=1_000)
    name = one_line(wanted[0]) if wanted else ""
    raise UsageError(
        f"{NAME} does not have exactly one column named '{name}'",
        remedy="Name the column with --canvas-column (make: CANVAS_COLUMN='its name'). "
        f"Its columns: {listed or 'none'}.",
    )


def _need_gradebook(header: list[str]) -> None:
    names = "Student" in header[0] and len(header) > 3 and "ID" in header[1]
    split = header[:2] == ["LastName", "FirstName"] and len(header) > 4 and "ID" in header[2]
    if not (names or split) or "Section" not in header:
        raise UsageError(
            "this is not a Canvas gradebook: it does not begin with Student, ID", remedy=REMEDY
        )


def _is_called(header: str, name: str) -> bool:
    match = TITLE_AND_ID.fullmatch(header)
    known = {header, match["title"], match["id"]} if match else {header}
    return name.strip().casefold() in {one.casefold() for one in known}


def _possible(sheet: Sheet, column: int) -> str:
    """Return the cell of the row `Points Possible`, "" if there is none."""
    for row in range(1, len(sheet.rows)):
        if "Points Possible" in sheet.value(row, 0):
            return sheet.value(row, column)
    return ""


def _points_warning(sheet: Sheet, column: int, result: ClassResult) -> list[str]:
    possible = _possible(sheet, column)
    if not possible or cells.number(result.max_score) == cells.number(as_number(possible)):
        return []
    return [
        f"the assignment is worth {possible} points in Canvas and {cells.number(result.max_score)} "
        "here: the grades were not converted"
    ]


def _warnings(result: ClassResult, match: Match) -> Iterator[str]:
    """Yield a warning for each student without exactly one row or found by name only."""
    for entry in result.entries:
        if entry.status == "unclear":
            continue  # the class says it already
        if entry.student.key not in match.rows:
            yield f"{_who(entry)} is not in the gradebook: nothing was filled in"
        elif entry.student.key in match.by_name:
            yield f"{_who(entry)} was found in the gradebook by name only"


def _email(student: Student) -> tuple[str, ...]:
    return (student.email.strip().casefold(),) if student.email.strip() else ()


def _login(line: Student) -> tuple[str, ...]:
    return (line.username.strip().casefold(),) if line.username.strip() else ()


def _who(entry: GradebookEntry) -> str:
    return one_line(entry.student.name or entry.student.key, most=100)
