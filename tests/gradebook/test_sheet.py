"""An instructor's CSV file is read as `csv` reads it, and only the filled cells change."""

from __future__ import annotations

import csv
import io

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grader.base.errors import UsageError
from grader.batch.sheet import Sheet
from tests.gradebook.hostile_texts import texts

bits = st.lists(st.sampled_from(["a", "ß", '"', ",", ";", "\t", "\r", "\n", "\r\n", " "])).map(
    "".join
)


def rows_of(content: bytes, delimiter: str) -> list[list[str]]:
    text = content.decode("utf-8-sig")
    return [row for row in csv.reader(io.StringIO(text, newline=""), delimiter=delimiter) if row]


@given(bits.filter(lambda text: text.strip("\r\n") != ""), st.booleans())
def test_every_text_is_read_as_the_csv_module_reads_it(text: str, bom: bool) -> None:
    content = text.encode("utf-8-sig" if bom else "utf-8")
    sheet = Sheet(content, name="x")
    assert [[c.value for c in row] for row in sheet.rows] == rows_of(content, sheet.delimiter)
    assert sheet.filled({}) == content


@given(
    st.lists(
        st.lists(texts.map(lambda t: t.replace("\x00", "")), min_size=3, max_size=3), min_size=2
    ),
    st.sampled_from([",", ";", "\t"]),
    st.sampled_from(["\n", "\r\n"]),
    texts.map(lambda t: t.replace("\x00", "")),
)
def test_filling_a_cell_changes_no_other(
    rows: list[list[str]], delimiter: str, end: str, value: str
) -> None:
    rows[0] = ["Identifier", "Grade", "Feedback"]
    rows = [[cell.encode("utf-8", "replace").decode() for cell in row] for row in rows]
    value = value.encode("utf-8", "replace").decode()
    out = io.StringIO()
    csv.writer(out, delimiter=delimiter, lineterminator=end, quoting=csv.QUOTE_ALL).writerows(rows)
    before = out.getvalue().encode()
    after = Sheet(before, name="x").filled({(1, 1): value})
    rows[1][1] = value
    assert rows_of(after, delimiter) == rows
    assert after.startswith(before[: before.index(end.encode())])


def test_bytes_around_a_filled_cell_stay() -> None:
    before = b'\xef\xbb\xbfa;"b"; c \r\n"x""y";1;  z\n\r\n"q";;\xc3\xa4'
    after = Sheet(before, name="x").filled({(1, 1): "95", (2, 1): "a;b"})
    assert after == b'\xef\xbb\xbfa;"b"; c \r\n"x""y";95;  z\n\r\n"q";"a;b";\xc3\xa4'


@pytest.mark.parametrize(
    ("encoding", "name", "output"),
    [
        ("cp949", "김민지", "CP949"),
        ("cp949", "뷁 가나다라마", "CP949"),
        ("cp1252", "Änn Å€", "Windows-1252"),
        # valid CP949 as well: a Hangul syllable that hardly occurs in names
        ("cp1252", "Åsa Berg", "Windows-1252"),
        ("latin-1", "Zo\xeb \x81", "Latin-1"),
        ("utf-16", "김민지", ""),
        ("utf-8-sig", "김민지", ""),
    ],
)
def test_every_spreadsheet_encoding_is_read_and_written_as_utf8(
    encoding: str, name: str, output: str
) -> None:
    sheet = Sheet(f"a,b\n{name},1\n".encode(encoding), name="the file")
    assert sheet.value(1, 0) == name
    assert (output in sheet.note) if output else not sheet.note
    assert sheet.filled({(1, 1): "2"}) == f"a,b\n{name},2\n".encode("utf-8-sig")


@pytest.mark.parametrize(
    ("content", "output"),
    [
        (b"\xff\xfea", "is not valid UTF-16"),
        (b"PK\x03\x04\x00\x00", "is not a CSV file"),
        (b"", "is empty"),
        (b"\n\n", "is empty"),
    ],
)
def test_a_file_that_is_not_csv_is_refused(content: bytes, output: str) -> None:
    with pytest.raises(UsageError, match=output):
        Sheet(content, name="the file")
