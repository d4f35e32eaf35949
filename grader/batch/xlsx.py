"""Reads and writes `.xlsx` files of Excel and LibreOffice, with openpyxl."""

from __future__ import annotations

import csv
import io
import re
import zipfile
from collections.abc import Mapping, Sequence
from datetime import datetime, time

from grader.base.errors import UsageError

MOST_BYTES = 200_000_000  # of an unpacked file
MOST_ROWS, MOST_COLUMNS = 100_000, 500
DATE = (1980, 1, 1, 0, 0, 0)  # the same content gives the same bytes
CHANGED = re.compile(rb"(<dcterms:(created|modified)[^>]*>)[^<]*(</dcterms)")
WIDEST = 60  # characters of a column
NOT_ALLOWED = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f]")
Cell = str | float | None
"""A text, a number, or nothing."""


def as_csv(content: bytes, name: str) -> tuple[bytes, str]:
    """Return the first sheet of a workbook as CSV in UTF-8, and a note if there are more sheets.

    A formula has its last result. Raises UsageError if it is not an .xlsx file, or too large.
    """
    from openpyxl import load_workbook  # noqa: PLC0415 - slow

    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            size = sum(member.file_size for member in archive.infolist())
        if size > MOST_BYTES:
            raise UsageError(f"{name} is too large: {size:,} bytes unpacked")
        book = load_workbook(io.BytesIO(content), read_only=True, data_only=True)
        sheet = book.worksheets[0]
        rows: list[list[str]] = []
        for row in sheet.iter_rows(max_col=MOST_COLUMNS, values_only=True):
            if len(rows) > MOST_ROWS:
                raise UsageError(f"{name} has more than {MOST_ROWS:,} rows")
            rows.append([_text(value) for value in row])
        others = [one.title for one in book.worksheets[1:]]
    except UsageError:
        raise
    except Exception as error:  # openpyxl raises whatever a damaged file causes
        raise UsageError(
            f"{name} cannot be read as an .xlsx file: {type(error).__name__}",
            remedy="Save it in the spreadsheet as 'CSV UTF-8'.",
        ) from error
    out = io.StringIO()
    csv.writer(out).writerows(_trimmed(rows))
    note = f"{name}: only its first sheet, '{sheet.title}', was read" if others else ""
    return out.getvalue().encode(), note


def _text(value: object) -> str:
    if value is None:
        return ""
    if isinstance(value, float) and value.is_integer():
        return str(int(value))  # an id number
    if isinstance(value, datetime):
        return f"{value:%Y-%m-%d}" if value.time() == time() else f"{value:%Y-%m-%d %H:%M:%S}"
    return str(value)


def _trimmed(rows: Sequence[Sequence[str]]) -> list[list[str]]:
    """Return the rows without the empty columns and rows at the end."""
    width = max((n + 1 for row in rows for n, text in enumerate(row) if text), default=0)
    kept = [[*row[:width], *([""] * (width - len(row)))] for row in rows]
    while kept and not any(kept[-1]):
        kept.pop()
    return kept


def workbook(sheets: Mapping[str, Sequence[Sequence[Cell]]]) -> bytes:
    """Return a workbook of these sheets, each with a header line; a text is never a formula."""
    from openpyxl import Workbook  # noqa: PLC0415 - slow
    from openpyxl.styles import Font  # noqa: PLC0415
    from openpyxl.utils import get_column_letter  # noqa: PLC0415

    book = Workbook()
    book.remove(book.active)
    for title, rows in sheets.items():
        sheet = book.create_sheet(title)
        for n, row in enumerate(rows, start=1):
            for column, value in enumerate(row, start=1):
                if value is None or value == "":
                    continue
                cell = sheet.cell(n, column)
                if isinstance(value, str):
                    cell.value = NOT_ALLOWED.sub("", value)
                    cell.data_type = "s"  # also if it begins with =
                else:
                    cell.value = value
        for cell in sheet[1]:
            cell.font = Font(bold=True)
        sheet.freeze_panes = "B2"
        for column in range(1, sheet.max_column + 1):
            texts = [str(row[column - 1] or "") for row in rows if len(row) >= column]
            width = min(WIDEST, max(map(len, texts), default=0) + 2)
            sheet.column_dimensions[get_column_letter(column)].width = width
    out = io.BytesIO()
    book.save(out)
    return _without_dates(out.getvalue())


def _without_dates(content: bytes) -> bytes:
    """Return the same workbook without the time at which it was written."""
    out = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(content)) as old,
        zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as new,
    ):
        for member in old.infolist():
            data = old.read(member)
            if member.filename == "docProps/core.xml":
                data = CHANGED.sub(rb"\g<1>1980-01-01T00:00:00Z\g<3>", data)
            fresh = zipfile.ZipInfo(member.filename, DATE)
            fresh.compress_type = zipfile.ZIP_DEFLATED
            new.writestr(fresh, data)
    return out.getvalue()
