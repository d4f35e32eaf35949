"""gradebook.csv: it has everybody with the points of their reports, and no cell is a formula."""

from __future__ import annotations

import csv
import dataclasses
import io
import re

from hypothesis import given, settings
from hypothesis import strategies as st

from grader.batch.model import ClassResult
from grader.publish.gradebook_csv import gradebook_csv
from tests.gradebook.hostile_texts import hostile_class, texts
from tests.report import samples

FORMULA = re.compile(r"[\s\"']*[=+\-@＝＋－＠]")


def table(content: bytes) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(content.decode("utf-8-sig"), newline="")))


def test_every_student_has_the_points_of_each_check(mixed: ClassResult) -> None:
    rows = table(gradebook_csv(mixed))
    assert [row["key"] for row in rows] == [entry.student.key for entry in mixed.entries]
    for row, entry in zip(rows, mixed.entries, strict=True):
        assert row["status"] == entry.status
        assert (row["final"] == "") == (entry.final is None)
        if entry.final is None or entry.report is None or entry.report.inconclusive:
            continue
        assert float(row["final"]) == entry.final
        known = [float(row[check.id]) for check in entry.report.checks if row[check.id]]
        assert sum(known) - entry.penalty == entry.final
        assert set(row["mistakes"].split()) == {
            m.id for check in entry.report.checks for m in check.mistakes
        }


def test_corrections_lateness_and_times_are_columns(mixed: ClassResult) -> None:
    rows = {row["key"]: row for row in table(gradebook_csv(mixed))}
    assert rows["1009"]["run.output"] == "10"
    assert "M. Curie" in rows["1009"]["notes"]
    assert "shown to work in the laboratory" in rows["1009"]["notes"]
    assert (rows["1003"]["penalty"], rows["1003"]["late"]) == ("5", "7800")
    assert rows["1003"]["submitted"] == "2026-11-20T19:00:00+00:00"
    assert rows["1011"]["run.period"] == "", "points that nobody knows are no zero"
    assert "in the middle" in rows["1013"]["notes"]


@settings(max_examples=60)
@given(st.lists(texts, min_size=1, max_size=2))
def test_no_text_becomes_a_formula_or_a_new_row(found: list[str]) -> None:
    content = gradebook_csv(hostile_class(*found))
    rows = table(content)
    assert len(rows) == len(found)
    for row in rows:
        for name in ("name", "email", "username", "id_number", "section", "mistakes", "notes"):
            assert "\n" not in row[name]
            # in countries whose spreadsheets split at semicolons
            for piece in row[name].split(";"):
                assert not FORMULA.match(piece) or piece.lstrip(' "').startswith("'")
            assert row[name].isprintable()


def test_a_name_with_commas_and_quotes_is_read_back_unchanged() -> None:
    result = hostile_class("x")
    student = dataclasses.replace(result.entries[0].student, name='O\'Neil, "Jim" 名')
    entry = dataclasses.replace(result.entries[0], student=student)
    rows = table(gradebook_csv(dataclasses.replace(result, entries=(entry,)), bom=True))
    assert rows[0]["name"] == student.name


def test_the_byte_order_mark_is_written_on_request() -> None:
    result = hostile_class("x")
    assert gradebook_csv(result, bom=True) == b"\xef\xbb\xbf" + gradebook_csv(result)


def test_the_points_of_a_check_are_the_corrected_ones_last_of_all() -> None:
    from grader.batch.model import Override
    from grader.batch.points import marks, single

    first = Override("1", "entry_point.mapping", 3, "half")
    last = Override("1", "entry_point.mapping", 15, "all")
    entry = single(samples.failing_report(), overrides=(first, last))
    given = {mark.check.id: mark.points for mark in marks(entry)}
    assert given["entry_point.mapping"] == 15
