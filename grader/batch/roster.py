"""The list of a class' students, as the course's system or the instructor keeps it: a CSV file."""

from __future__ import annotations

import difflib
import unicodedata
from collections.abc import Callable
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from grader.batch.model import Student
from grader.batch.roster_columns import KNOWN
from grader.batch.roster_columns import Columns
from grader.batch.roster_columns import Kind
from grader.batch.roster_columns import columns_of
from grader.batch.roster_columns import participant
from grader.batch.systems.gradescope_yaml import instant
from grader.errors import UsageError
from grader.gradebook.sheet import Sheet
from grader.intake.notes import shown
from grader.intake.reading import MEGABYTE
from grader.intake.reading import Unread
from grader.intake.reading import read_bytes
from grader.report.plain import one_line

LARGEST = 20 * MEGABYTE
LONGEST = 300  # characters of a cell
ZIP = b"PK\x03\x04"  # a spreadsheet of Excel or LibreOffice
NO_STUDENT = ("points possible", "manual posting", "student, test", "test student")
AS_CSV = "Save it in the spreadsheet as 'CSV UTF-8'."


@dataclass(frozen=True)
class Roster:
    """A class' students in the order of their file; `kind` tells whose numbers the keys are.

    `submitted` is when each of them handed in, as the course's system says (UTC; None: it does not).
    """

    students: tuple[Student, ...]
    kind: Kind
    notes: tuple[str, ...] = ()
    submitted: tuple[datetime | None, ...] = ()

    def submitted_by(self, row: int) -> datetime | None:
        """Return when the student of a row handed in, None if the file does not say."""
        return self.submitted[row] if self.submitted else None


def read_roster(path: Path) -> Roster:
    """Read a roster with a header line, whatever its delimiter, encoding and order of columns.

    UsageError, with the file and the line, for what cannot be read, for a header that tells nobody
    apart, and for a student who is in it twice.
    """
    name = shown(str(path))
    text, notes = _decoded(_content(path, name), name)
    first, _, rest = text.partition("\n")
    skipped = 0
    if first.strip().lower().startswith("sep="):  # Excel's own line
        text, skipped = rest, 1
    sheet = Sheet(text.encode(), name=f"the roster {name}")

    def line(row: int) -> int:
        return skipped + _line(text, sheet.rows[row][0].start)

    columns = columns_of(sheet)
    if not columns.tells_people_apart:
        raise UsageError(f"{name}:{line(0)}: {_no_columns(sheet.header)}", remedy=_remedy())
    rows = [(row, _student(sheet, row, columns)) for row in range(1, len(sheet.rows))]
    people = [(row, student) for row, student in rows if student is not None]
    _no_twins(people, name, line)
    notes += _left_out(name, [line(row) for row, student in rows if student is None])
    if not people:
        raise UsageError(f"{name}:{line(0)}: there is no student below the header")
    return Roster(
        tuple(student for _, student in people),
        columns.kind,
        tuple(notes),
        tuple(_submitted(sheet, row, columns) for row, _ in people),
    )


def _content(path: Path, name: str) -> bytes:
    try:
        resolved = path.resolve(strict=True)
    except (OSError, ValueError, RuntimeError):
        raise UsageError(f"there is no roster {name}") from None
    content = read_bytes(resolved, LARGEST)
    if isinstance(content, Unread):
        raise UsageError(f"the roster {name} cannot be read: {content.reason}")
    if content.startswith(ZIP):
        raise UsageError(f"the roster {name} is a spreadsheet and no CSV file", remedy=AS_CSV)
    return content


def _decoded(content: bytes, name: str) -> tuple[str, list[str]]:
    """Return the text, without a byte order mark, and what was guessed about it."""
    for mark, encoding in (
        (b"\xef\xbb\xbf", "utf-8"),
        (b"\xff\xfe", "utf-16"),
        (b"\xfe\xff", "utf-16"),
    ):
        if content.startswith(mark):
            try:
                return content.decode(encoding).removeprefix("\ufeff"), []
            except UnicodeDecodeError as error:
                raise UsageError(
                    f"the roster {name} says of itself that it is {encoding.upper()}, and is not "
                    f"(byte {error.start})",
                    remedy=AS_CSV,
                ) from None
    if b"\0" in content[:4_000]:
        raise UsageError(
            f"the roster {name} is no CSV file: it has zero bytes in it", remedy=AS_CSV
        )
    try:
        return content.decode("utf-8"), []
    except UnicodeDecodeError:
        note = (
            f"the roster {name} is not UTF-8: it was read as Latin-1 (Windows-1252), see the names"
        )
    try:
        return content.decode("cp1252"), [note]
    except UnicodeDecodeError:
        return content.decode("latin-1"), [note]


def _line(text: str, position: int) -> int:
    before = text[:position].replace("\r\n", "\n")
    return before.count("\n") + before.count("\r") + 1


def _student(sheet: Sheet, row: int, columns: Columns) -> Student | None:
    """Return a row's student, None if there is nobody in it."""

    def cell(field: str) -> str:
        texts = (sheet.value(row, index) for index in columns.of(field))
        found = next((text for text in texts if text), "")
        return unicodedata.normalize("NFC", one_line(found, most=LONGEST))

    first, last = cell("first name"), cell("last name")
    name = cell("name") or f"{first} {last}".strip()
    if any(sheet.value(row, index).casefold() in NO_STUDENT for index in columns.of("name")):
        return None
    email, username, number = cell("email"), cell("username"), cell("id number")
    key = participant(cell("key")) if columns.kind == "moodle" else cell("key")
    if columns.kind == "github_classroom":
        identifier, key = key, ""
        email = email or (identifier if "@" in identifier else "")
        number = number or (identifier if identifier != email else "")
        name = name or identifier
    key = key or number or username or email or name
    if not key:
        return None
    return Student(
        key=key,
        name=_in_order(name) or key,
        email=email,
        username=username,
        id_number=number,
        section=cell("section"),
    )


def _submitted(sheet: Sheet, row: int, columns: Columns) -> datetime | None:
    """Return the time of submission in a row; None for an empty cell and for what is no time."""
    stamps = (instant(sheet.value(row, index)) for index in columns.of("submitted"))
    return next((stamp for stamp in stamps if stamp is not None), None)


def _in_order(name: str) -> str:
    """Return `Lee, Ann` as `Ann Lee`; other names as they are."""
    last, comma, first = name.partition(", ")
    return f"{first} {last}" if comma and first and last and "," not in first else name


def _no_columns(header: list[str]) -> str:
    names = ", ".join(f"'{one_line(name, most=40)}'" for name in header[:10])
    for name in header:
        close = difflib.get_close_matches(name.casefold(), KNOWN, n=1, cutoff=0.7)
        if close:
            return f"no column tells who a student is: {names} (did you mean '{close[0]}'?)"
    return f"no column tells who a student is: {names}"


def _remedy() -> str:
    return (
        "The first line names the columns; at least one of: name (or first name and last name), "
        "email, username, id number. Exports of Moodle, Canvas, Gradescope and GitHub Classroom "
        "are read as they are."
    )


def _no_twins(people: list[tuple[int, Student]], name: str, line: Callable[[int], int]) -> None:
    seen: dict[tuple[str, str], int] = {}
    for row, student in people:
        for what, value in _marks(student):
            mark = (what, value.casefold())
            if mark in seen:
                raise UsageError(
                    f"{name}:{line(row)}: the {what} '{value}' is in line {line(seen[mark])} too",
                    remedy="Take one of the two lines out, or correct it.",
                )
            seen[mark] = row


def _marks(student: Student) -> Iterator[tuple[str, str]]:
    """Yield what nobody shares with anybody; a name does not count."""
    if student.key not in (student.name, student.id_number, student.username, student.email):
        yield "id", student.key
    for what, value in (
        ("id number", student.id_number),
        ("username", student.username),
        ("email address", student.email),
    ):
        if value:
            yield what, value


def _left_out(name: str, lines: list[int]) -> list[str]:
    if not lines:
        return []
    more = f" and {len(lines) - 10} more" if len(lines) > 10 else ""
    listed = ", ".join(str(line) for line in lines[:10])
    return [f"the roster {name} has lines that are no student's: {listed}{more}"]
