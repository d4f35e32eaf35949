"""The instructor's worksheet comes back with only Grade and Feedback filled in."""

from __future__ import annotations

import csv
import dataclasses
import io

import pytest
from hypothesis import given, settings

from grader.base.errors import UsageError
from grader.batch.model import ClassResult
from grader.batch.systems.known import SYSTEMS
from tests.gradebook.fill import fill_worksheet
from tests.gradebook.hostile_texts import hostile_class, texts
from tests.pages import classes
from tests.report import samples

ENGLISH = (
    "Identifier,Full name,ID number,Email address,Status,Group,Grade,Maximum Grade,"
    "Grade can be changed,Last modified (submission),Last modified (grade),Feedback comments"
)
GERMAN = (
    "ID;Vollständiger Name;E-Mail-Adresse;Status;Bewertung;Bestwertung;Bewertung kann geändert "
    "werden;Zuletzt geändert (Abgabe);Zuletzt geändert (Bewertung);Feedback als Kommentar"
)


def english(*numbers: int, end: str = "\r\n", maximum: str = "100.00") -> bytes:
    lines = [ENGLISH]
    lines += [
        f'Participant {1000 + n},"{classes.student(n).name}",{n},student{n}@example.org,'
        '"Submitted, late",'
        f'Group A,,{maximum},Yes,"Friday, 20 November 2026, 7:00 PM",-,"old ""text"""'
        for n in numbers
    ]
    return (end.join(lines) + end).encode()


def rows(content: bytes, delimiter: str = ",") -> list[dict[str, str]]:
    text = content.decode("utf-8-sig")
    return list(csv.DictReader(io.StringIO(text, newline=""), delimiter=delimiter))


def class_of_one(number: int = 0, **fields: object) -> ClassResult:
    fields = {"score": 85, "final": 85, **fields}
    return classes.result([classes.entry(number, samples.failing_report(), **fields)])


@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_only_grade_and_feedback_change(mixed: ClassResult, end: str) -> None:
    worksheet = english(*range(24), 77, end=end)
    filled = fill_worksheet(worksheet, mixed)
    before, after = rows(worksheet), rows(filled.content)
    assert len(before) == len(after)
    for old, new, entry in zip(before, after, (*mixed.entries, None), strict=True):
        changed = {name for name in old if old[name] != new[name]}
        if entry is None or entry.final is None:
            assert changed == set()
        else:
            assert changed == {"Grade", "Feedback comments"}
            assert float(new["Grade"]) == entry.final
    assert filled.content.count(b"\r\n") == worksheet.count(b"\r\n")
    assert filled.warnings == ()


def test_corrections_and_lateness_are_in_the_feedback(mixed: ClassResult) -> None:
    after = rows(fill_worksheet(english(*range(24)), mixed).content)
    assert "shown to work in the laboratory" in after[9]["Feedback comments"]
    assert "Late by 2 h 10 min: 5 points taken" in after[3]["Feedback comments"]
    assert "1 hidden check: not shown" in after[5]["Feedback comments"]
    assert "run.logger" not in after[5]["Feedback comments"]


def test_a_german_worksheet_with_semicolons_bom_and_decimal_comma() -> None:
    worksheet = (
        b"\xef\xbb\xbf"
        + f"{GERMAN}\nTeilnehmer/in1000;Ann;;Abgegeben;;100,00;Ja;-;-;\n"
        f"Teilnehmer/in1001;Bea;;Abgegeben;12,00;100,00;Ja;-;-;gut\n".encode()
    )
    filled = fill_worksheet(worksheet, class_of_one(score=85.5, final=85.5))
    after = rows(filled.content, ";")
    assert after[0]["Bewertung"] == "85,5"
    assert after[0]["Feedback als Kommentar"].startswith("<p>")
    assert after[1] == rows(worksheet, ";")[1]
    assert filled.content.startswith(b"\xef\xbb\xbfID;")


def test_other_column_orders_and_unknown_columns_are_accepted() -> None:
    worksheet = (
        b"Groupe,Remarques,Note,Note maximale,Commentaires de feedback,Identifiant\n"
        b"Groupe 1,x,,100.00,,Participant1000\nGroupe 1,y,,100.00,,Participant1002\n"
    )
    after = rows(fill_worksheet(worksheet, class_of_one()).content)
    assert after[0]["Note"] == "85"
    assert after[0]["Remarques"] == "x"
    assert after[1]["Note"] == ""


def test_an_unknown_language_works_if_the_columns_are_named() -> None:
    worksheet = b"Kennung,Pisteet,Palaute\nOsallistuja 1000,,\nOsallistuja 1001,,\n"
    with pytest.raises(UsageError, match="Pisteet") as caught:
        fill_worksheet(worksheet, class_of_one())
    assert "--grade-column" in caught.value.remedy
    filled = fill_worksheet(
        worksheet, class_of_one(), grade_column="pisteet", feedback_column="Palaute"
    )
    assert rows(filled.content)[0]["Pisteet"] == "85"
    assert rows(filled.content)[0]["Palaute"].startswith("<p>")
    with pytest.raises(UsageError, match="no column 'Points'"):
        fill_worksheet(worksheet, class_of_one(), grade_column="Points")


def test_a_student_outside_the_worksheet_is_named() -> None:
    result = classes.result([classes.entry(n, samples.report()) for n in (0, 1)])
    filled = fill_worksheet(english(1, 2), result)
    assert filled.warnings == (
        f"{result.entries[0].student.name} is not in the worksheet: nothing was filled in",
    )
    assert [row["Grade"] for row in rows(filled.content)] == ["100", ""]


def test_a_class_of_another_system_is_matched_by_email_not_by_number() -> None:
    result = dataclasses.replace(class_of_one(1), system=SYSTEMS["folders"])
    swapped = (
        english(0, 1)
        .replace(b"Participant 1001", b"Participant 1")
        .replace(b"Participant 1000", b"Participant 1001")
    )
    after = rows(fill_worksheet(swapped, result).content)
    assert [row["Grade"] for row in after] == ["", "85"]


def test_a_grade_above_the_maximum_is_refused_with_the_name() -> None:
    result = class_of_one()
    with pytest.raises(UsageError) as caught:
        fill_worksheet(english(0, 1, maximum="50.00"), result)
    assert result.entries[0].student.name in caught.value.message
    assert "85" in caught.value.message
    assert "maximum grade in Moodle" in caught.value.remedy


@pytest.mark.parametrize(
    ("content", "output"),
    [
        (b"Student,ID,Section,Task (1)\nAnn,1,A,\n", "Participant"),
        (b"Identifier,Grade\n", "Participant"),
        (b"Identifier,Grade\nParticipant 1,\nParticipant 1,\n", "Participant"),
        (b"Identifier,Full name\nParticipant 1000,Ann\n", "no column of grades"),
        (b"Identifier,Full name,Grade\nParticipant 1000,Ann\n", "damaged"),
    ],
)
def test_a_file_that_is_not_a_worksheet_is_refused(content: bytes, output: str) -> None:
    with pytest.raises(UsageError, match=output):
        fill_worksheet(content, class_of_one())


@settings(max_examples=60)
@given(texts)
def test_no_submission_text_breaks_a_cell_in_php_or_html(text: str) -> None:
    worksheet = english(0, 1)
    result = hostile_class(text)
    # the row is identified by number and name
    student = dataclasses.replace(result.entries[0].student, name=classes.student(0).name)
    entry = dataclasses.replace(result.entries[0], student=student)
    result = dataclasses.replace(result, entries=(entry,))
    content = fill_worksheet(worksheet, result).content
    after = rows(content)
    # PHP's fgetcsv reads a backslash as an escape; both readers must get the same
    escaping = csv.DictReader(
        io.StringIO(content.decode(), newline=""), escapechar="\\", doublequote=True
    )
    assert list(escaping) == after
    cell = after[0]["Feedback comments"]
    assert not set('\\"\r\n') & set(cell)
    assert cell.isprintable()
    assert "<script" not in cell
    for name in set(after[0]) - {"Grade", "Feedback comments"}:
        assert after[0][name] == rows(worksheet)[0][name]
