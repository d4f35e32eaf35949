"""Moodle's gradebook import: an unknown user would stop it, so ambiguous users are left out."""

from __future__ import annotations

import csv
import dataclasses
import io

from hypothesis import given, settings
from hypothesis import strategies as st

from grader.batch.model import ClassResult
from grader.batch.systems.moodle.gradebook_import import moodle_import
from tests.gradebook.fill import comment
from tests.gradebook.hostile_texts import hostile_class, texts
from tests.pages import classes
from tests.report import samples


def rows(content: bytes) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(content.decode(), newline="")))


def test_each_student_has_one_row_by_id_number(mixed: ClassResult) -> None:
    found = {row["ID number"]: row for row in rows(moodle_import(mixed, comment).content)}
    final = {entry.student.id_number: entry.final for entry in mixed.entries}
    assert found.keys() == {number for number, points in final.items() if points is not None}
    assert {number: float(row[mixed.title]) for number, row in found.items()} == {
        number: final[number] for number in found
    }
    assert "laboratory" in found[mixed.entries[9].student.id_number]["Feedback"]


def test_a_student_without_a_grade_has_no_row(mixed: ClassResult) -> None:
    """grade/import/csv reads `-` and an empty cell as null and overwrites the grade with it."""
    assert any(entry.final is None for entry in mixed.entries)
    assert {row[mixed.title] for row in rows(moodle_import(mixed, comment).content)}.isdisjoint(
        {"-", ""}
    )


def test_an_ambiguous_student_is_left_out_and_named() -> None:
    entries = [classes.entry(n, samples.report()) for n in range(5)]

    def with_email(n: int, email: str) -> None:
        student = dataclasses.replace(entries[n].student, email=email)
        entries[n] = dataclasses.replace(entries[n], student=student)

    with_email(0, "")
    with_email(1, "=1+1@example.org")
    with_email(2, "twice@example.org")
    with_email(3, "twice@example.org")
    made = moodle_import(classes.result(entries), comment, by="email")
    assert [row["Email address"] for row in rows(made.content)] == ["student4@example.org"]
    assert len(made.warnings) == 4
    for entry, warning in zip(entries, made.warnings, strict=False):
        assert entry.student.name in warning


def test_the_field_that_most_students_have_identifies_them() -> None:
    entries = [classes.entry(n, samples.report()) for n in range(3)]
    bare = [
        dataclasses.replace(e, student=dataclasses.replace(e.student, id_number="", email=""))
        for e in entries
    ]
    assert "Username" in rows(moodle_import(classes.result(bare), comment).content)[0]
    assert "ID number" in rows(moodle_import(classes.result(entries), comment).content)[0]


@settings(max_examples=40)
@given(st.lists(texts, min_size=1, max_size=3))
def test_hostile_names_stay_in_their_cells(found: list[str]) -> None:
    made = moodle_import(hostile_class(*found), comment)
    read = rows(made.content)
    assert len(read) + len(made.warnings) == len(found)
    assert all(None not in row and None not in row.values() for row in read)
