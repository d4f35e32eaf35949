"""Reads the list of a class' students from a CSV file of a system or the instructor."""

from __future__ import annotations

import unicodedata
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from datetime import tzinfo
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.i18n.message import say, some_of
from grader.base.nearest import nearest
from grader.base.plain_text import one_line
from grader.batch.instructor_csv import read_csv
from grader.batch.model import Student
from grader.batch.roster_columns import KNOWN, RosterColumns, columns_of, form_of
from grader.batch.roster_guess import EMAIL
from grader.batch.sheet import Sheet
from grader.batch.systems.gradescope.metadata import instant
from grader.batch.systems.system import RosterForm, System
from grader.batch.times import Times

LONGEST = 300  # characters of a cell
NO_STUDENT = ("points possible", "manual posting", "student, test", "test student")


@dataclass(frozen=True)
class RosterLine:
    """A student's line: `row` is its number in the sheet, `group` the student's group.

    `evidence` says in words which submission or grade of the student the system knows, "" if none.
    `times` is what the system says about the time of submission. `unknown` are the cells of
    unrecognised columns, by the columns' names.
    """

    student: Student
    row: int = 0
    group: str = ""
    evidence: str = ""
    times: Times = field(default_factory=Times)
    unknown: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Roster:
    """A class' students in the order of the file; `system`: whose numbers the keys are, if any."""

    lines: tuple[RosterLine, ...]
    system: System | None = None
    name: str = "the roster"
    notes: tuple[str, ...] = ()

    @property
    def students(self) -> tuple[Student, ...]:
        """The students of the lines."""
        return tuple(line.student for line in self.lines)

    @property
    def has_times(self) -> bool:
        """Whether the list says when a submission was handed in."""
        return any(line.times.say_something for line in self.lines)

    def in_zone(self, zone: tzinfo | None) -> Roster:
        """Return the roster with all times in UTC; those without a zone are in `zone`."""
        lines = (replace(line, times=line.times.in_zone(zone)) for line in self.lines)
        return replace(self, lines=tuple(lines))

    @property
    def form(self) -> RosterForm:
        """How a list of that system is read."""
        return form_of(self.system)


def read_roster(path: Path) -> Roster:
    """Read a roster with a header line, in any encoding, with any delimiter and order of columns.

    Raises UsageError, with file and line, if it cannot be read, if no column identifies a student,
    or if a student is in it twice.
    """
    file = read_csv(path, "the roster")
    sheet, name, place = file.sheet, file.name, file.place
    columns = columns_of(sheet)
    if not columns.identifies_students or _has_no_header(sheet):
        raise UsageError(f"{place(0)}: {_no_columns(sheet)}", remedy=_remedy())
    roster = roster_of(sheet, f"the roster {name}", columns)
    _no_duplicates(roster.lines, place)
    if not roster.lines:
        raise UsageError(f"{place(0)}: there are no students below the header")
    left_out = sorted(set(range(1, len(sheet.rows))) - {line.row for line in roster.lines})
    numbers = [place(row).rpartition(":")[2] for row in left_out]
    notes = (file.note, *roster.notes, *_left_out(name, numbers))
    return replace(roster, notes=tuple(note for note in notes if note))


def roster_of(sheet: Sheet, name: str, columns: RosterColumns | None = None) -> Roster:
    """Return the students of a sheet that was already read (a worksheet, for example)."""
    columns = columns_of(sheet) if columns is None else columns
    lines = tuple(
        RosterLine(
            student=student,
            row=row,
            group=_cell(sheet, row, columns, "group"),
            evidence=_evidence(sheet, row, columns),
            times=_times(sheet, row, columns),
            unknown={sheet.header[i]: sheet.value(row, i) for i in columns.unknown},
        )
        for row in range(1, len(sheet.rows))
        if (student := _student(sheet, row, columns)) is not None
    )
    guesses = ", ".join(one_line(guess, most=100) for guess in columns.guesses)
    notes = (f"{name}: columns with unknown names were recognised by their content: {guesses}",)
    return Roster(lines, columns.system, name, notes if guesses else ())


def _evidence(sheet: Sheet, row: int, columns: RosterColumns) -> str:
    """Return which submission or grade of a student the system knows, in words; "" if none."""
    form = columns.form
    cells = {field: _cell(sheet, row, columns, field) for field in form.fields}
    return form.evidence(cells)


def _cell(sheet: Sheet, row: int, columns: RosterColumns, name: str) -> str:
    texts = (sheet.value(row, index) for index in columns.of(name))
    found = next((text for text in texts if text), "")
    return unicodedata.normalize("NFC", one_line(found, most=LONGEST))


def _student(sheet: Sheet, row: int, columns: RosterColumns) -> Student | None:
    """Return a row's student, None if it has none."""

    def cell(name: str) -> str:
        return _cell(sheet, row, columns, name)

    first, last = cell("first name"), cell("last name")
    name = cell("name") or f"{first} {last}".strip()
    if any(sheet.value(row, index).casefold() in NO_STUDENT for index in columns.of("name")):
        return None
    email, username, number = cell("email"), cell("username"), cell("id number")
    form = columns.form
    key = form.number(cell("key"))
    if form.is_identity:
        identifier, key = key, ""
        email = email or (identifier if "@" in identifier else "")
        number = number or (identifier if identifier != email else "")
        name = name or identifier
    key = key or number or username or email or name
    if not key:
        return None
    return Student(
        key=key,
        name=_first_name_first(name) or key,
        email=email,
        username=username,
        id_number=number,
        section=cell("section") or cell("group"),
    )


def _times(sheet: Sheet, row: int, columns: RosterColumns) -> Times:
    """Return what a row says about the time of submission."""
    form = columns.form
    if form.times is not None:
        return form.times({field: _cell(sheet, row, columns, field) for field in form.fields})
    stamps = (instant(sheet.value(row, index)) for index in columns.of("submitted"))
    return Times(submitted=next((stamp for stamp in stamps if stamp is not None), None))


def _first_name_first(name: str) -> str:
    """Return `Lee, Ann` as `Ann Lee`; other names as they are."""
    last, comma, first = name.partition(", ")
    return f"{first} {last}" if comma and first and last and "," not in first else name


def _has_no_header(sheet: Sheet) -> bool:
    """Whether the first line is already a student's: it contains an email address."""
    return any(EMAIL.fullmatch(name) for name in sheet.header)


def _no_columns(sheet: Sheet) -> str:
    names = ", ".join(f"'{one_line(name, most=40)}'" for name in sheet.header[:10])
    if _has_no_header(sheet):
        return f"the first line must name the columns, but it has an email address: {names}"
    for name in sheet.header:
        close = nearest(name, KNOWN, cutoff=0.7)
        if close:
            return f"no column identifies a student: {names} (did you mean '{close}'?)"
    return f"no column identifies a student: {names}"


def _remedy() -> str:
    return (
        "The first line must name the columns, at least one of: name (or first name and last name), "
        "email, username, id number, in English or Korean. Exports of Moodle, Canvas, Gradescope "
        "and GitHub Classroom are read as they are."
    )


def _no_duplicates(lines: tuple[RosterLine, ...], place: Callable[[int], str]) -> None:
    seen: dict[tuple[str, str], int] = {}
    for line in lines:
        for what, value in _identifiers(line.student):
            identifier = (what, value.casefold())
            if identifier in seen:
                other = place(seen[identifier]).rpartition(":")[2]
                raise UsageError(
                    f"{place(line.row)}: the {what} '{value}' is also in line {other}",
                    remedy="Remove or correct one of the two lines.",
                )
            seen[identifier] = line.row


def _identifiers(student: Student) -> Iterator[tuple[str, str]]:
    """Yield the values that are unique to a student; a name is not."""
    if student.key not in (student.name, student.id_number, student.username, student.email):
        yield "id", student.key
    for what, value in (
        ("id number", student.id_number),
        ("username", student.username),
        ("email address", student.email),
    ):
        if value:
            yield what, value


def _left_out(name: str, lines: list[str]) -> list[str]:
    if not lines:
        return []
    some = some_of(lines, 10)
    return [say("the roster {name} has lines without a student: {lines}", name=name, lines=some)]
