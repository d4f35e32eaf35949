"""Canvas' gradebook, read by the rules of its importer (lib/gradebook_importer.rb)."""

from __future__ import annotations

import csv
import dataclasses
import io
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grader.base.errors import UsageError
from grader.batch.model import ClassResult
from grader.batch.systems.canvas.write import new_gradebook
from grader.batch.systems.known import SYSTEMS
from tests.gradebook.fill import fill_gradebook
from tests.gradebook.hostile_texts import hostile_class, texts
from tests.pages import classes
from tests.report import samples

TASK = "Hello time (4711)"
HEADER = f"Student,ID,SIS User ID,SIS Login ID,Section,Other (12),{TASK},Current Score"
POSSIBLE = "    Points Possible,,,,,10.00,100.00,(read only)"


def export(*lines: str, end: str = "\n") -> bytes:
    return (end.join([HEADER, *lines]) + end).encode()


def student(number: int, grade: str = "") -> str:
    return f'"Lee, Ann {number}",{1000 + number},{number},user{number},"A, B",7.5,{grade},88.1'


def canvas_reads(content: bytes) -> tuple[list[str], list[list[str]]]:
    """Return header and students as the importer reads them; InvalidHeaderRow is an assertion."""
    lines = content.decode("utf-8-sig").splitlines()[:3]
    counts = {sep: {len(next(csv.reader([line], delimiter=sep))) for line in lines} for sep in ";,"}
    fields = {sep: found.pop() if len(found) == 1 else 0 for sep, found in counts.items()}
    sep = ";" if fields[";"] > fields[","] else ","
    text = io.StringIO(content.decode("utf-8-sig"), newline="")
    rows = [row for row in csv.reader(text, delimiter=sep) if row and any(row)]
    header = rows[0]
    assert len(header) > 3
    assert "Student" in header[0]
    assert "ID" in header[1]
    assert re.search(r"SIS\s+User\s+ID", header[2])
    assert re.search(r"SIS\s+Login\s+ID", header[3])
    assert "Section" in header[4]
    students = [
        row
        for row in rows[1:]
        if "Points Possible" not in row[0]
        and not all(re.fullmatch(r"\s*(Muted|Manual Posting.*)?\s*", cell, re.I) for cell in row)
    ]
    return header, students


def hello(*numbers: int, **fields: object) -> ClassResult:
    entries = [classes.entry(n, samples.report(), **fields) for n in numbers]
    return classes.result(entries, title="Hello time", system=SYSTEMS["canvas"])


@pytest.mark.parametrize("column", ["", "Hello time", TASK, "4711"])
def test_one_column_is_filled_and_nothing_else_changes(column: str) -> None:
    before = export("    ,,,,,,Manual Posting,", POSSIBLE, student(0), student(1, "3"))
    filled = fill_gradebook(before, hello(0, 1, score=91.25, final=91.25), column=column)
    expected = export(
        "    ,,,,,,Manual Posting,", POSSIBLE, student(0, "91.25"), student(1, "91.25")
    )
    assert filled.content == expected
    assert filled.warnings == ()
    header, rows = canvas_reads(filled.content)
    assert [row[header.index(TASK)] for row in rows] == ["91.25", "91.25"]


def test_excused_and_not_assigned_students_are_kept() -> None:
    before = export(POSSIBLE, student(0, "EX"), student(1, "N/A"), student(2), student(3, "5"))
    result = hello(0, 1, 2)
    filled = fill_gradebook(before, result)
    assert filled.content == export(
        POSSIBLE, student(0, "EX"), student(1, "N/A"), student(2, "100"), student(3, "5")
    )
    assert [warning.rpartition(": ")[2] for warning in filled.warnings] == ["kept", "kept"]


def test_semicolons_and_decimal_commas_stay() -> None:
    before = export(POSSIBLE, student(0), student(1, "88.50"))
    before = before.replace(b", ", b"\0").replace(b",", b";").replace(b"\0", b", ")
    before = re.sub(rb"(\d)\.(\d)", rb"\1,\2", before)
    filled = fill_gradebook(before, hello(0, score=91.5, final=91.5))
    header, rows = canvas_reads(filled.content)
    assert [row[header.index(TASK)] for row in rows] == ["91,5", "88,50"]


def test_missing_and_pending_students_get_nothing_and_unknown_ones_are_named(
    mixed: ClassResult,
) -> None:
    result = dataclasses.replace(mixed, title="Hello time", system=SYSTEMS["canvas"])
    before = export(POSSIBLE, *(student(n) for n in range(23)))
    filled = fill_gradebook(before, result)
    header, rows = canvas_reads(filled.content)
    for row, entry in zip(rows, result.entries[:23], strict=True):
        given = row[header.index(TASK)]
        assert given == "" if entry.final is None else float(given) == entry.final
    stranger = result.entries[23].student.name
    assert filled.warnings == (f"{stranger} is not in the gradebook: nothing was filled in",)


def test_a_class_of_another_system_is_matched_by_login() -> None:
    result = dataclasses.replace(hello(1), system=SYSTEMS["folders"])
    filled = fill_gradebook(export(POSSIBLE, student(0), student(1)), result)
    assert filled.content == export(POSSIBLE, student(0), student(1, "100"))


def test_different_points_possible_are_reported() -> None:
    before = export(POSSIBLE.replace("100.00", "20"), student(0))
    assert "100 here" in fill_gradebook(before, hello(0)).warnings[0]


@pytest.mark.parametrize(
    ("content", "column", "output"),
    [
        (b"Identifier,Grade\nParticipant 1,\n", "", "not a Canvas gradebook"),
        (export(POSSIBLE, student(0)), "Hello tim", "Hello tim"),
        (export(POSSIBLE, student(0)), "Current Score", "Current Score"),
        (export(POSSIBLE.replace("100.00", "(read only)"), student(0)), "", "read only"),
        (export(POSSIBLE, '"Lee",1000,0'), "", "too short"),
    ],
)
def test_an_unusable_gradebook_is_refused(content: bytes, column: str, output: str) -> None:
    with pytest.raises(UsageError) as caught:
        fill_gradebook(content, hello(0), column=column)
    assert output in str(caught.value)


@settings(max_examples=60)
@given(st.lists(texts, min_size=1, max_size=3))
def test_a_new_gradebook_can_be_read_by_canvas(found: list[str]) -> None:
    result = dataclasses.replace(hostile_class(*found), system=SYSTEMS["canvas"], title="Hello")
    header, rows = canvas_reads(new_gradebook(result))
    assert header[5:] == ["Hello"]
    assert [row[1] for row in rows] == [entry.student.key for entry in result.entries]
    assert {row[5] for row in rows} == {"56"}
    assert not any(cell[:1] in "=+-@" for row in rows for cell in row if cell)
