"""An instructor's CSV file in which some cells are replaced; every other byte stays the same.

It is read as Python's `csv` reads it. The position of each cell is kept, so that delimiter, quotes,
line ends, byte order mark and unknown columns are preserved. Only a file that is not UTF-8 becomes
UTF-8, which the learning management systems read.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from grader.base.errors import UsageError
from grader.batch.decoded import BOM, decoded

DELIMITERS = (",", ";", "\t")
DECIMAL_COMMA = re.compile(r"\s*-?\d+,\d+\s*")
DECIMAL_POINT = re.compile(r"\s*-?\d+\.\d+\s*")


def folded_header(name: str) -> str:
    """Return a column's name for comparisons: without capitals, and without blanks in Korean."""
    words = name.casefold().replace("_", " ").split()
    # blanks between Korean words are optional: 이메일 주소, 이메일주소
    return (" " if name.isascii() else "").join(words)


@dataclass(frozen=True)
class CsvCell:
    """A cell's value and its position in the text: `start` to `end`, including quotes."""

    value: str
    start: int
    end: int
    quoted: bool


@dataclass(frozen=True)
class Filled:
    """A file that was filled in, and warnings for the instructor."""

    content: bytes
    warnings: tuple[str, ...] = ()


class Sheet:
    """The rows of a CSV file, the header first; blank lines are skipped (and stay in the file)."""

    def __init__(self, content: bytes, *, name: str) -> None:
        """Read a file, called `name` in errors; raise UsageError if it is not a CSV file."""
        found = decoded(content, name)
        self._text = found.text
        self.note = found.note
        self._bom = BOM if found.marked else b""
        if "\0" in self._text:
            raise UsageError(f"{name} is not a CSV file: it contains zero bytes")
        heads = {d: next(_rows(self._text, d), []) for d in DELIMITERS}
        self.delimiter = max(DELIMITERS, key=lambda d: len(heads[d]))
        self.rows = tuple(_rows(self._text, self.delimiter))
        if not self.rows:
            raise UsageError(f"{name} is empty")

    @property
    def header(self) -> list[str]:
        """The names of the columns, stripped."""
        return [cell.value.strip() for cell in self.rows[0]]

    def column(self, index: int) -> list[str]:
        """Return the values below the header, "" if a row is too short."""
        return [self.value(row, index) for row in range(1, len(self.rows))]

    def value(self, row: int, column: int) -> str:
        """Return a cell's value, stripped; "" if the row is too short."""
        cells = self.rows[row]
        return cells[column].value.strip() if column < len(cells) else ""

    def has_cell(self, row: int, column: int) -> bool:
        """Return whether the row has a cell in this column."""
        return column < len(self.rows[row])

    def decimal_comma(self, *columns: int) -> bool:
        """Return whether the numbers in these columns are written as 85,5."""
        values = [value for column in columns for value in self.column(column)]
        commas = any(DECIMAL_COMMA.fullmatch(value) for value in values)
        return commas and not any(DECIMAL_POINT.fullmatch(value) for value in values)

    def filled(self, changes: Mapping[tuple[int, int], str]) -> bytes:
        """Return the file with new values in some cells, given by (row, column)."""
        parts = []
        position = 0
        for row, column in sorted(changes):
            cell = self.rows[row][column]
            parts.append(self._text[position : cell.start])
            parts.append(self._written(changes[row, column], quoted=cell.quoted))
            position = cell.end
        parts.append(self._text[position:])
        return self._bom + "".join(parts).encode()

    def _written(self, value: str, *, quoted: bool) -> str:
        special = any(character in value for character in (self.delimiter, '"', "\r", "\n"))
        if quoted or special or value != value.strip():
            return '"' + value.replace('"', '""') + '"'
        return value


def _rows(text: str, delimiter: str) -> Iterator[list[CsvCell]]:
    """Yield the rows of a text that are not blank."""
    position, cells = 0, []
    while position < len(text):
        cell = _cell(text, position, delimiter)
        cells.append(cell)
        position = cell.end
        if position < len(text) and text[position] == delimiter:
            position += 1
            if position == len(text):  # the file ends with an empty cell
                cells.append(CsvCell("", position, position, quoted=False))
            continue
        if len(cells) > 1 or cells[0].end > cells[0].start:
            yield cells
        cells = []
        position += 2 if text.startswith("\r\n", position) else 1
    if cells:
        yield cells


def _cell(text: str, start: int, delimiter: str) -> CsvCell:
    quoted = text.startswith('"', start)
    value, position = _in_quotes(text, start + 1) if quoted else ("", start)
    end = position
    while end < len(text) and text[end] not in (delimiter, "\r", "\n"):
        end += 1
    return CsvCell(value + text[position:end], start, end, quoted)


def _in_quotes(text: str, position: int) -> tuple[str, int]:
    """Return the quoted value that begins at `position`, and the position after its quotes."""
    parts: list[str] = []
    while True:
        end = text.find('"', position)
        if end < 0:
            return "".join(parts) + text[position:], len(text)
        parts.append(text[position:end])
        if not text.startswith('""', end):
            return "".join(parts), end + 1
        parts.append('"')
        position = end + 2
