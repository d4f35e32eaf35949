"""Canvas' gradebook CSV: one column of the teacher's export filled in, or a new file.

By Canvas' lib/gradebook_importer.rb: the first cells are the student's (`Student`, `ID`, SIS ids,
`Section`), then columns `Title (assignment id)`; a row `    Points Possible`, in which `(read
only)` marks what the import ignores; perhaps a row that says `Manual Posting`; `EX` is an excused
student, and `N/A` one who does not have the assignment.
"""

from __future__ import annotations

import csv
import io
import re

from grader.batch.model import ClassResult
from grader.batch.model import Entry
from grader.errors import UsageError
from grader.gradebook import cells
from grader.gradebook.sheet import Filled
from grader.gradebook.sheet import Sheet
from grader.report.plain import one_line

NAME = "the Canvas gradebook"
REMEDY = "In Canvas: Grades, Export, Export Entire Gradebook."
OWN = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")
POSSIBLE = "    Points Possible"
TITLE_AND_ID = re.compile(r"(?P<title>.*?)\s*\((?P<id>\d+)\)")
KEPT = ("EX", "N/A")
READ_ONLY = re.compile(r"read\s+only")
# columns that Canvas computes; the names may stand after a group's and before a period's
COMPUTED = re.compile(r"(Current|Final) (Score|Points|Grade)|Override (Score|Grade|Status)")


def fill_gradebook(gradebook: bytes, result: ClassResult, *, column: str = "") -> Filled:
    """Return the teacher's export with one assignment's column filled in.

    `column` is its header, its title or its number (default: the class's title or assignment).
    Rows of students without a final result, and cells with EX or N/A, stay as they are.
    UsageError for a file that is no gradebook, and if the column cannot be told.
    """
    sheet = Sheet(gradebook, name=NAME)
    index = _column(sheet, column, result)
    warnings = _points_warning(sheet, index, result)
    comma = sheet.decimal_comma(index)
    rows, missing = _join(sheet, result)
    warnings += [
        f"{_who(entry)} is not in the gradebook: nothing was filled in" for entry in missing
    ]
    changes: dict[tuple[int, int], str] = {}
    for row, entry in rows.items():
        if entry.final is None:
            continue
        if not sheet.has_cell(row, index):
            raise UsageError(f"{NAME} is damaged: the row of {_who(entry)} is too short")
        if sheet.value(row, index).upper() in KEPT:
            warnings.append(f"{_who(entry)} has {sheet.value(row, index)} in Canvas: kept")
        else:
            changes[row, index] = cells.number(entry.final, comma=comma)
    return Filled(sheet.filled(changes), tuple(warnings))


def new_gradebook(result: ClassResult, *, title: str = "") -> bytes:
    """Return a gradebook of one new column; Canvas makes the assignment when it takes it in."""
    out = io.StringIO()
    table = csv.writer(out)
    table.writerow([*OWN, cells.text(title or result.title or result.assignment)])
    table.writerow([POSSIBLE, *[""] * (len(OWN) - 1), cells.number(result.max_score)])
    for entry in result.entries:
        student = entry.student
        number = student.key if result.system == "canvas" else ""
        who = (student.name, number, student.id_number, student.username, student.section)
        table.writerow([*(cells.text(value) for value in who), cells.number(entry.final)])
    return out.getvalue().encode()


def _column(sheet: Sheet, column: str, result: ClassResult) -> int:
    header = sheet.header
    _need_gradebook(header)
    first = _first_assignment(sheet)
    open_ = [i for i in range(first, len(header)) if not COMPUTED.search(header[i])]
    wanted = [column] if column else [result.title, result.assignment]
    for name in wanted:
        fit = [index for index in open_ if name and _is_called(header[index], name)]
        if len(fit) == 1:
            if READ_ONLY.search(_possible(sheet, fit[0])):
                raise UsageError(f"{NAME}: the column '{header[fit[0]]}' is read only")
            return fit[0]
    listed = one_line(", ".join(f"'{header[index]}'" for index in open_), most=1_000)
    raise UsageError(
        f"{NAME} has not one column that is called '{one_line(wanted[0])}'",
        remedy=f"Name the column with --canvas-column. There are: {listed or 'none'}.",
    )


def _need_gradebook(header: list[str]) -> None:
    names = "Student" in header[0] and len(header) > 3 and "ID" in header[1]
    split = header[:2] == ["LastName", "FirstName"] and len(header) > 4 and "ID" in header[2]
    if not (names or split) or "Section" not in header:
        raise UsageError(f"{NAME} is none: it does not begin with Student, ID", remedy=REMEDY)


def _first_assignment(sheet: Sheet) -> int:
    return sheet.header.index("Section") + 1


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
    if not possible or cells.number(result.max_score) == cells.number(_as_number(possible)):
        return []
    return [
        f"Canvas has {possible} points for this assignment, the class is marked out of "
        f"{cells.number(result.max_score)}: the points went in as they are"
    ]


def _as_number(text: str) -> float | None:
    try:
        return float(text.replace(",", "."))
    except ValueError:
        return None


def _join(sheet: Sheet, result: ClassResult) -> tuple[dict[int, Entry], list[Entry]]:
    """Return each row's entry, and those that have no row (or more than one)."""
    rows = [row for row in range(1, len(sheet.rows)) if _is_student(sheet, row)]
    found: dict[int, Entry] = {}
    missing = []
    for entry in result.entries:
        row = _row_of(sheet, rows, entry, result)
        if row is None or row in found:
            missing.append(entry)
        else:
            found[row] = entry
    return found, missing


def _row_of(sheet: Sheet, rows: list[int], entry: Entry, result: ClassResult) -> int | None:
    """Return the one row that has the student's id, else SIS id, else login."""
    student, header = entry.student, sheet.header
    known = (
        ("ID", student.key if result.system == "canvas" else ""),
        ("SIS User ID", student.id_number),
        ("SIS Login ID", student.username),
        ("SIS Login ID", student.email),
    )
    for name, key in known:
        if not key.strip() or name not in header:
            continue
        column, wanted = header.index(name), key.strip().casefold()
        fit = [row for row in rows if sheet.value(row, column).casefold() == wanted]
        if len(fit) == 1:
            return fit[0]
    return None


def _is_student(sheet: Sheet, row: int) -> bool:
    """Return whether a row is a student's: not the points, nor `Manual Posting`."""
    if "Points Possible" in sheet.value(row, 0):
        return False
    return any(sheet.value(row, index) for index in range(_first_assignment(sheet)))


def _who(entry: Entry) -> str:
    return one_line(entry.student.name or entry.student.key, most=100)
