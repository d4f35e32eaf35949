"""Moodle's offline grading worksheet: fills grades and feedback into the instructor's own file.

Moodle's import (mod/assign/feedback/offline/importgradeslib.php) finds columns by their names in
the site's language and students by the number in `Participant 123`. It silently skips grades above
the maximum, so they are refused here.
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
from grader.batch.roster_columns import columns_of
from grader.batch.sheet import Filled, Sheet
from grader.batch.systems.moodle import SYSTEM
from grader.batch.systems.moodle.words import FEEDBACK, GRADE, IDENTIFIER, MAXIMUM
from grader.batch.systems.system import System

PARTICIPANT = re.compile(r"([^\W\d_][^\d]*?)\s*(\d+)")  # a word in any script, then the number
NUMBER = re.compile(r"\d+(?:[.,]\d+)?")
NAME = "the Moodle worksheet"
REMEDY = (
    "In Moodle: assignment, View all submissions, Grading action, Download grading worksheet "
    "(the assignment needs 'Offline grading worksheet' among its feedback types)."
)
NO_FEEDBACK = "the worksheet has no column of feedback comments: only grades are filled in"


@dataclass(frozen=True)
class WorksheetColumns:
    """The indexes of the columns, None if there is no such column."""

    identifier: int
    grade: int
    maximum: int | None
    feedback: int | None


@dataclass(frozen=True)
class Worksheet:
    """A worksheet: its columns, and the student of each row."""

    sheet: Sheet
    columns: WorksheetColumns
    roster: Roster
    notes: tuple[str, ...] = ()

    def match(self, students: Sequence[Student], system: System) -> Match:
        """Return the roster line of each student, by key."""
        found = Match()
        rules = rules_for_people(system, students, self.roster)
        match_more(found, rules, students, self.roster)
        return found

    def elsewhere(self, students: Sequence[Student], system: System) -> dict[str, Elsewhere]:
        """Return the students whose submission or grade is in Moodle, by key."""
        rows = self.match(students, system).rows
        found = {key: self.roster.lines[row].evidence for key, row in rows.items()}
        return {key: Elsewhere(reason) for key, reason in found.items() if reason}

    def existing(self, result: ClassResult) -> list[tuple[GradebookEntry, str]]:
        """Return the entries that are filled in, each with the cell of its grade as it is."""
        return [
            (entry, self.sheet.value(row, self.columns.grade))
            for row, entry in self._filled_in(result, self._match(result))
        ]

    def filled(self, result: ClassResult, comment: Comment) -> Filled:
        """Return the worksheet with grade and feedback of every student with a final grade.

        No cell changes for a student without a submission here if Moodle has a submission or a
        grade. Raises UsageError for a grade above the maximum.
        """
        sheet, columns = self.sheet, self.columns
        match = self._match(result)
        comma = sheet.decimal_comma(columns.grade, *_only(columns.maximum))
        changes: dict[tuple[int, int], str] = {}
        too_many: list[str] = []
        for row, entry in self._filled_in(result, match):
            if _above(sheet, row, columns, entry.final):
                too_many.append(f"{_who(entry)}: {cells.number(entry.final)}")
            changes[row, columns.grade] = cells.number(entry.final, comma=comma)
            if columns.feedback is not None:
                changes[row, columns.feedback] = comment(entry)
        if too_many:
            raise _too_many(", ".join(too_many), result.max_score)
        return Filled(sheet.filled(changes), tuple(_warnings(result, match)))

    def _match(self, result: ClassResult) -> Match:
        return self.match([entry.student for entry in result.entries], result.system)

    def _filled_in(self, result: ClassResult, match: Match) -> Iterator[tuple[int, GradebookEntry]]:
        """Yield the rows that get a grade, with their entries."""
        for entry in result.entries:
            index = match.rows.get(entry.student.key)
            if index is None or entry.final is None:
                continue
            line = self.roster.lines[index]
            if is_without_verdict(entry) and (line.evidence or entry.keeps_grade):
                continue
            yield line.row, entry


def read_worksheet(
    content: bytes,
    *,
    grade_column: str = "",
    feedback_column: str = "",
    max_score: float | None = None,
) -> Worksheet:
    """Read a worksheet and find its columns.

    `grade_column` and `feedback_column` name these columns if their language is unknown;
    `max_score` is the assignment's maximum. Raises UsageError if the file is not a worksheet, is
    damaged, or allows fewer points.
    """
    sheet = Sheet(content, name=NAME)
    columns = _columns(sheet, grade_column, feedback_column)
    roster = roster_of(sheet, NAME, columns_of(sheet, exported=(SYSTEM, columns.identifier)))
    _need_cells(sheet, columns, roster)
    if max_score is not None:
        for line in roster.lines:
            if _above(sheet, line.row, columns, max_score):
                raise _too_many(f"the assignment is worth {cells.number(max_score)}", max_score)
    notes = (sheet.note, "" if columns.feedback is not None else NO_FEEDBACK)
    return Worksheet(sheet, columns, roster, tuple(note for note in notes if note))


def _columns(sheet: Sheet, grade_column: str, feedback_column: str) -> WorksheetColumns:
    header = sheet.header
    identifier = _identifier(sheet)
    grade = _named(header, grade_column) if grade_column else _one_of(header, GRADE)
    if grade is None:
        raise UsageError(
            f"no column of grades was recognised in {NAME}; its columns: {_listed(header)}",
            remedy="Name the column: --grade-column 'its name' (make: GRADE_COLUMN='its name').",
        )
    feedback = _named(header, feedback_column) if feedback_column else _feedback(header)
    return WorksheetColumns(identifier, grade, _maximum(sheet, grade), feedback)


def _identifier(sheet: Sheet) -> int:
    """Return the column of `Participant 123`: the same word, and a different number in each row."""
    header = sheet.header
    fit = [index for index in range(len(header)) if _is_identifier(sheet.column(index))]
    by_name = [index for index in fit if header[index].casefold() in IDENTIFIER]
    if not fit:
        raise UsageError(
            f"{NAME} has no column with 'Participant' and a number in each row; "
            f"its columns: {_listed(header)}",
            remedy=REMEDY,
        )
    return (by_name or fit)[0]


def _is_identifier(values: list[str]) -> bool:
    found = [PARTICIPANT.fullmatch(value) for value in values]
    whole = [match for match in found if match is not None]
    if not whole or len(whole) < len(found):
        return False
    words = {match.group(1) for match in whole}
    return len(words) == 1 and len({match.group(2) for match in whole}) == len(whole)


def _one_of(header: list[str], names: frozenset[str]) -> int | None:
    fit = [index for index, name in enumerate(header) if name.casefold() in names]
    return fit[0] if len(fit) == 1 else None


def _named(header: list[str], name: str) -> int:
    fit = [index for index, found in enumerate(header) if found.casefold() == name.casefold()]
    if len(fit) != 1:
        count = "no column" if not fit else f"{len(fit)} columns"
        raise UsageError(f"{NAME} has {count} '{name}'; its columns: {_listed(header)}")
    return fit[0]


def _feedback(header: list[str]) -> int | None:
    exact = _one_of(header, FEEDBACK)
    if exact is not None:
        return exact
    fit = [index for index, name in enumerate(header) if "feedback" in name.casefold()]
    return fit[0] if len(fit) == 1 else None


def _maximum(sheet: Sheet, grade: int) -> int | None:
    """Return the column of the maximum: by name, or after the grade if all numbers are equal."""
    fit = [i for i, name in enumerate(sheet.header) if MAXIMUM.search(name.casefold())]
    fit = [index for index in fit if index != grade] or [grade + 1]
    values = set(sheet.column(fit[0]))
    numbers = [value for value in values if NUMBER.fullmatch(value)]
    return fit[0] if len(values) == 1 and len(numbers) == 1 else None


def _warnings(result: ClassResult, match: Match) -> Iterator[str]:
    """Yield a warning for each student without a row or found by name only."""
    for entry in result.entries:
        if entry.status == "unclear":
            continue  # the class says it already
        if entry.student.key not in match.rows:
            yield f"{_who(entry)} is not in the worksheet: nothing was filled in"
        elif entry.student.key in match.by_name:
            yield f"{_who(entry)} was found in the worksheet by name only"


def _need_cells(sheet: Sheet, columns: WorksheetColumns, roster: Roster) -> None:
    for line in roster.lines:
        for column in (columns.grade, *_only(columns.feedback)):
            if not sheet.has_cell(line.row, column):
                who = one_line(line.student.name, most=100)
                raise UsageError(
                    f"{NAME} is damaged: the row of {who} is shorter than the header",
                    remedy="Download it again, and do not edit it by hand.",
                )


def _above(sheet: Sheet, row: int, columns: WorksheetColumns, points: float | None) -> bool:
    """Whether `points` exceed the maximum of a row."""
    if columns.maximum is None or points is None:
        return False
    most = sheet.value(row, columns.maximum).replace(",", ".")
    return bool(NUMBER.fullmatch(most)) and points > float(most)


def _too_many(what: str, max_score: float) -> UsageError:
    return UsageError(
        f"more points than {NAME} allows: {what}",
        remedy="Set the assignment's maximum grade in Moodle to the assignment's points "
        f"({cells.number(max_score)}), then download the worksheet again.",
    )


def _only(column: int | None) -> tuple[int, ...]:
    return () if column is None else (column,)


def _who(entry: GradebookEntry) -> str:
    return one_line(entry.student.name or entry.student.key, most=100)


def _listed(header: list[str]) -> str:
    return one_line(", ".join(header), most=600)
