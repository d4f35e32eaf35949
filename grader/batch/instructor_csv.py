"""Reads a CSV or .xlsx file that an instructor gives: in any encoding, with any delimiter, with a header line."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.nearest import meant, nearest, nearest_path
from grader.base.plain_text import one_line
from grader.base.shown import shown
from grader.batch.decoded import decoded
from grader.batch.sheet import Sheet
from grader.batch.xlsx import as_csv
from grader.package.intake.reading import MEGABYTE, Unread, read_bytes

LARGEST = 20 * MEGABYTE
ZIP = b"PK\x03\x04"  # a spreadsheet of Excel or LibreOffice
MOST_ERRORS = 10  # of one file, that are listed


@dataclass(frozen=True)
class InstructorCsv:
    """The rows of a file: `name` is its path for people, `note` what was assumed about its encoding.

    `skipped` lines come before the header.
    """

    sheet: Sheet
    name: str
    text: str
    note: str = ""
    skipped: int = 0

    def line(self, row: int) -> int:
        """Return the number of the line in which a row begins, from 1."""
        before = self.text[: self.sheet.rows[row][0].start].replace("\r\n", "\n")
        return self.skipped + before.count("\n") + before.count("\r") + 1

    def place(self, row: int) -> str:
        """Return where a row is: the file and its line."""
        return f"{self.name}:{self.line(row)}"


def read_csv(path: Path, what: str) -> InstructorCsv:
    """Read a file, called `what` in errors; raise UsageError if it cannot be read as CSV."""
    name = shown(str(path))
    content, note = _content(path, name, what), ""
    if content.startswith(ZIP):
        content, note = as_csv(content, f"{what} {name}")
    found = decoded(content, f"{what} {name}")
    text, skipped = found.text, 0
    first, _, rest = text.partition("\n")
    if first.strip().lower().startswith("sep="):  # written by Excel
        text, skipped = rest, 1
    sheet = Sheet(text.encode(), name=f"{what} {name}")
    return InstructorCsv(sheet, name, text, note or found.note, skipped)


def _content(path: Path, name: str, what: str) -> bytes:
    try:
        resolved = path.resolve(strict=True)
    except (OSError, ValueError, RuntimeError):
        kind = what.removeprefix("the ")
        raise UsageError(f"there is no {kind} {name}{meant(nearest_path(path))}") from None
    content = read_bytes(resolved, LARGEST)
    if isinstance(content, Unread):
        raise UsageError(f"{what} {name} cannot be read: {content.reason}")
    return content


def did_you_mean(word: str, words: Collection[str]) -> str:
    """Return the nearest known word as a question in brackets, "" if none is near."""
    close = nearest(word, words)
    return f" (did you mean '{one_line(close, most=80)}'?)" if close else ""


def raise_all(errors: Collection[str], remedy: str = "") -> None:
    """Raise UsageError with every error of a file, one in each line; nothing if there is none."""
    if not errors:
        return
    listed = [*errors][:MOST_ERRORS]
    more = [f"and {len(errors) - MOST_ERRORS} more errors"] if len(errors) > MOST_ERRORS else []
    raise UsageError("\n".join([*listed, *more]), remedy=remedy)
