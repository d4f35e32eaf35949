"""An instructor's CSV file with a student in each row: extensions, times of submission."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator, Mapping, Sequence

from grader.base.errors import UsageError
from grader.base.plain_text import one_line
from grader.batch.find_student import StudentIndex
from grader.batch.given_files import GivenFile
from grader.batch.instructor_csv import did_you_mean, raise_all, read_csv
from grader.batch.model import Student
from grader.batch.roster import LONGEST
from grader.batch.roster_columns import KNOWN, fields_by_name, named_columns
from grader.batch.sheet import folded_header

MOST_TEXT = 4_000  # characters of a comment
SURE = ("key", "id number", "email", "username")  # fields that are one student's


class StudentCsv:
    """The rows of a file; its student columns have the names that a roster's have.

    `own` are the names of the file's own columns, by field.
    """

    def __init__(
        self,
        given: GivenFile,
        what: str,
        own: Mapping[str, tuple[str, ...]],
        students: StudentIndex,
    ) -> None:
        """Read the file; raise UsageError if it is no CSV file, or has a column twice."""
        self.file = read_csv(given.path, what)
        self.is_remembered = given.is_remembered
        self._students = students
        header = [folded_header(name) for name in self.file.sheet.header]
        named = fields_by_name(header)
        self._own = {field: named_columns(header, names) for field, names in own.items()}
        taken = {index for found in self._own.values() for index in found}
        self._fields = {
            field: tuple(index for index in found if index not in taken)
            for field, found in {**named, "key": named_columns(header, ("key",))}.items()
        }
        words = {*KNOWN, "key", *(name for names in own.values() for name in names)}
        used = {*taken, *(index for found in self._fields.values() for index in found)}
        self.unknown = [
            f"'{one_line(name, most=40)}'{did_you_mean(name.casefold(), words)}"
            for index, name in enumerate(self.file.sheet.header)
            if index not in used and name
        ]
        self.errors: list[str] = []
        self.notes: list[str] = [self.file.note] if self.file.note else []

    def require(self, *fields: str) -> None:
        """Raise UsageError if the file has none of these columns of its own."""
        if any(self._own[field] for field in fields):
            return
        others = f"; unknown: {', '.join(self.unknown)}" if self.unknown else ""
        raise UsageError(f"{self.file.place(0)}: it has no column {' or '.join(fields)}{others}")

    def rows(self) -> Iterator[int]:
        """Yield the numbers of the rows below the header that have any value."""
        sheet = self.file.sheet
        for row in range(1, len(sheet.rows)):
            if any(cell.value.strip() for cell in sheet.rows[row]):
                yield row

    def cell(self, row: int, field: str) -> str:
        """Return a cell of the file's own columns, or of a roster's; "" without such a column."""
        columns = self._own.get(field) or self._fields.get(field, ())
        texts = (self.file.sheet.value(row, index) for index in columns)
        found = next((text for text in texts if text), "")
        return unicodedata.normalize("NFC", one_line(found, most=LONGEST))

    def text(self, row: int, field: str) -> str:
        """Return a text of several lines from one of the file's own columns, "" without it."""
        found = (self.file.sheet.value(row, index) for index in self._own.get(field, ()))
        text = next((text for text in found if text), "").replace("\r\n", "\n").strip()
        if len(text) > MOST_TEXT:
            raise UsageError(f"the {field} is longer than {MOST_TEXT} characters")
        return unicodedata.normalize("NFC", text)

    def error(self, row: int, error: UsageError) -> None:
        """Note an error of a row; a file of an earlier run may have rows that no longer fit."""
        remedy = f" ({error.remedy})" if error.remedy else ""
        text = f"{self.file.place(row)}: {error.message}{remedy}"
        (self.notes if self.is_remembered else self.errors).append(text)

    def raise_errors(self, nothing: str = "Nothing was marked.") -> None:
        """Raise UsageError with the errors of all rows, if there are any."""
        if self.unknown:
            self.notes.append(f"{self.file.name}: columns not read: {', '.join(self.unknown)}")
        raise_all(self.errors, f"{nothing} Correct {self.file.name}.")

    def names_student(self, row: int) -> bool:
        """Whether any cell of a row names a student."""
        fields = (*SURE, "name", "first name", "last name")
        return any(self.cell(row, field) for field in fields)

    def student(self, row: int) -> int:
        """Return the place of a row's student in the class.

        Raises UsageError if nobody is named, if it is nobody of the class, or if two cells of the
        row name two students.
        """
        sure = {word: self._students.find(word) for word in self._words(row)}
        if len(set(sure.values())) > 1:
            words = " and ".join(f"'{one_line(word, most=60)}'" for word in sure)
            raise UsageError(f"{words} are different students")
        name = self.cell(row, "name")
        name = name or f"{self.cell(row, 'first name')} {self.cell(row, 'last name')}".strip()
        if sure:
            found = next(iter(sure.values()))
            if name and self._is_somebody_else(name, found):
                word = one_line(next(iter(sure)), most=60)
                raise UsageError(f"'{word}' and '{one_line(name, most=60)}' are different students")
            return found
        if not name:
            raise UsageError("it names no student")
        return self._students.find(name)

    def _words(self, row: int) -> list[str]:
        return [word for field in SURE if (word := self.cell(row, field))]

    def _is_somebody_else(self, name: str, found: int) -> bool:
        try:
            return self._students.find(name) != found
        except UsageError:  # a nickname, or a name that several have
            return False


def sections(students: Sequence[Student]) -> dict[str, list[int]]:
    """Return the places of the students of each section, by its name in lower case."""
    found: dict[str, list[int]] = {}
    for place, student in enumerate(students):
        if student.section:
            found.setdefault(student.section.casefold(), []).append(place)
    return found
