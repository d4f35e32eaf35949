"""Moodle's offline grading worksheet: the teacher's own file with grades and feedback filled in.

Its reader (mod/assign/feedback/offline/importgradeslib.php) finds columns by their names in the
site's language and the student by the number in `Participant 123`; it skips grades above the
maximum without a word, so they are refused here.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from grader.batch.model import ClassResult
from grader.batch.model import Entry
from grader.errors import UsageError
from grader.gradebook import cells
from grader.gradebook.feedback import short_html
from grader.gradebook.moodle_words import FEEDBACK
from grader.gradebook.moodle_words import GRADE
from grader.gradebook.moodle_words import IDENTIFIER
from grader.gradebook.moodle_words import MAXIMUM
from grader.gradebook.sheet import Filled
from grader.gradebook.sheet import Sheet
from grader.report.plain import one_line

PARTICIPANT = re.compile(r"([^\W\d_][^\d]*?)\s*(\d+)")  # a word (in any script), then the number
NUMBER = re.compile(r"\d+(?:[.,]\d+)?")
NAME = "the Moodle worksheet"
REMEDY = (
    "In Moodle: assignment, View all submissions, Grading action, Download grading worksheet "
    "(the assignment needs 'Offline grading worksheet' among its feedback types)."
)


@dataclass(frozen=True)
class Columns:
    """Where things stand; None for a column that is not there."""

    identifier: int
    grade: int
    maximum: int | None
    feedback: int | None


def fill_worksheet(
    worksheet: bytes,
    result: ClassResult,
    *,
    grade_column: str = "",
    feedback_column: str = "",
    show_hidden: bool = False,
) -> Filled:
    """Return the worksheet with Grade and Feedback filled in for who has a final result.

    `grade_column` and `feedback_column` name these columns where their language is not known here.
    A class that did not come from Moodle is joined by email. UsageError for a file that is no
    worksheet, and for a grade above the maximum.
    """
    sheet = Sheet(worksheet, name=NAME)
    columns = _columns(sheet, grade_column, feedback_column)
    rows, warnings = _join(sheet, columns, result)
    comma = sheet.decimal_comma(columns.grade, *_only(columns.maximum))
    changes: dict[tuple[int, int], str] = {}
    too_many: list[str] = []
    for row, entry in rows.items():
        if entry.final is None:
            continue
        _need_cells(sheet, row, columns, entry)
        if _above_maximum(sheet, row, columns, entry):
            too_many.append(f"{_who(entry)}: {cells.number(entry.final)}")
        changes[row, columns.grade] = cells.number(entry.final, comma=comma)
        if columns.feedback is not None:
            changes[row, columns.feedback] = short_html(entry, show_hidden=show_hidden)
    if too_many:
        raise UsageError(
            f"more points than {NAME} allows: {', '.join(too_many)}",
            remedy="Set the assignment's maximum grade in Moodle to the points of the class "
            f"({cells.number(result.max_score)}), then download the worksheet again.",
        )
    if columns.feedback is None:
        warnings.append("the worksheet has no column of feedback comments: only grades went in")
    return Filled(sheet.filled(changes), tuple(warnings))


def _columns(sheet: Sheet, grade_column: str, feedback_column: str) -> Columns:
    header = sheet.header
    identifier = _identifier(sheet)
    grade = _named(header, grade_column) if grade_column else _one_of(header, GRADE)
    if grade is None:
        raise UsageError(
            f"{NAME} has no column of grades that is known here; its columns: {_listed(header)}",
            remedy="Name the column: --grade-column 'its name'.",
        )
    feedback = _named(header, feedback_column) if feedback_column else _feedback(header)
    return Columns(identifier, grade, _maximum(sheet, grade), feedback)


def _identifier(sheet: Sheet) -> int:
    """Return the column of `Participant 123`: one word, and a number of its own in each row."""
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
    """Return the column of the maximum: by its name, else the grade's neighbour of one number."""
    fit = [i for i, name in enumerate(sheet.header) if MAXIMUM.search(name.casefold())]
    fit = [index for index in fit if index != grade] or [grade + 1]
    values = set(sheet.column(fit[0]))
    numbers = [value for value in values if NUMBER.fullmatch(value)]
    return fit[0] if len(values) == 1 and len(numbers) == 1 else None


def _join(
    sheet: Sheet, columns: Columns, result: ClassResult
) -> tuple[dict[int, Entry], list[str]]:
    """Return each row's entry, and a warning for each student that has no row."""
    by_number: dict[str, int] = {}
    for row in range(1, len(sheet.rows)):
        match = PARTICIPANT.fullmatch(sheet.value(row, columns.identifier))
        if match is not None:
            by_number[match.group(2).lstrip("0")] = row
    emails = _emails(sheet)
    rows: dict[int, Entry] = {}
    warnings = []
    for entry in result.entries:
        row_found = _row_of(entry, by_number, emails, moodle=result.system == "moodle")
        if row_found is None or row_found in rows:
            warnings.append(f"{_who(entry)} is not in the worksheet: nothing was filled in")
        else:
            rows[row_found] = entry
    return rows, warnings


def _row_of(
    entry: Entry, by_number: Mapping[str, int], emails: Mapping[str, int], *, moodle: bool
) -> int | None:
    student = entry.student
    if moodle:  # only there is the key a participant's number
        return by_number.get(student.key.lstrip("0"))
    return emails.get(student.email.casefold()) if student.email else None


def _emails(sheet: Sheet) -> dict[str, int]:
    """Return the row of each email address that stands alone in a cell, and only once."""
    found: dict[str, list[int]] = {}
    for row, row_cells in enumerate(sheet.rows[1:], start=1):
        for value in {cell.value.strip().casefold() for cell in row_cells}:
            if "@" in value:
                found.setdefault(value, []).append(row)
    return {value: rows[0] for value, rows in found.items() if len(rows) == 1}


def _need_cells(sheet: Sheet, row: int, columns: Columns, entry: Entry) -> None:
    for column in (columns.grade, *_only(columns.feedback)):
        if not sheet.has_cell(row, column):
            raise UsageError(
                f"{NAME} is damaged: the row of {_who(entry)} is shorter than the header",
                remedy="Download it again, and do not edit it by hand.",
            )


def _above_maximum(sheet: Sheet, row: int, columns: Columns, entry: Entry) -> bool:
    if columns.maximum is None or entry.final is None:
        return False
    most = sheet.value(row, columns.maximum).replace(",", ".")
    return bool(NUMBER.fullmatch(most)) and entry.final > float(most)


def _only(column: int | None) -> tuple[int, ...]:
    return () if column is None else (column,)


def _who(entry: Entry) -> str:
    return one_line(entry.student.name or entry.student.key, most=100)


def _listed(header: list[str]) -> str:
    return one_line(", ".join(header), most=600)
