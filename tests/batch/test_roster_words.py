"""Rosters in Korean, in the encodings of spreadsheets, and in unknown languages."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from grader.base.errors import UsageError
from grader.batch.model import Student
from grader.batch.roster import Roster, read_roster
from grader.batch.systems.known import SYSTEMS
from grader.batch.systems.moodle.words import says_submitted
from grader.batch.systems.moodle.worksheet import read_worksheet
from tests.batch.downloads import ENGLISH, FINNISH, KOREAN, Words, people, worksheet

KIM = Student("2024001", "김민지", "kim@school.kr", "", "2024001")


def roster(tmp_path: Path, content: str, encoding: str = "utf-8") -> Roster:
    (tmp_path / "roster.csv").write_bytes(content.encode(encoding))
    return read_roster(tmp_path / "roster.csv")


@pytest.mark.parametrize(
    "header",
    [
        "이름,학번,이메일",
        "성명,학번,이메일 주소",
        "전체 이름,학생 번호,이메일주소",
        "학생명,id 번호,전자우편",
        "번호 아님,학번,이메일,이름",
    ],
)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp949", "utf-16"])
def test_a_korean_roster_is_read(tmp_path: Path, header: str, encoding: str) -> None:
    cells = ["김민지", "2024001", "kim@school.kr"]
    cells = ["x", *cells[1:], cells[0]] if header.count(",") == 3 else cells
    found = roster(tmp_path, f"{header}\n{','.join(cells)}\n", encoding)
    assert found.students == (KIM,)
    assert [("CP949" in note) for note in found.notes] == ([True] if encoding == "cp949" else [])


def test_family_and_given_name_may_be_separate_columns(tmp_path: Path) -> None:
    found = roster(tmp_path, "성,이름,분반,모둠\n김,민지,01,팀 1\n")
    assert [(one.name, one.section) for one in found.students] == [("민지 김", "01")]
    assert found.lines[0].group == "팀 1"


@pytest.mark.parametrize("words", [ENGLISH, KOREAN, replace(KOREAN, participant="참가자")])
@pytest.mark.parametrize(("encoding", "bom"), [("utf-8", False), ("utf-8", True), ("cp949", False)])
def test_moodles_worksheet_in_korean_is_read(
    tmp_path: Path, words: Words, encoding: str, bom: bool
) -> None:
    class_ = [replace(p, submitted=n > 1) for n, p in enumerate(people(6, korean=True))]
    class_[1] = replace(class_[1], grade="55.00")
    (tmp_path / "roster.csv").write_bytes(worksheet(class_, words, encoding=encoding, bom=bom))
    found = read_roster(tmp_path / "roster.csv")
    assert found.system is SYSTEMS["moodle"]
    assert found.students == tuple(
        Student(str(p.number), p.name, p.email, "", p.id_number) for p in class_
    )
    assert [bool(line.evidence) for line in found.lines] == [False, True, True, True, True, True]
    assert "55.00" in found.lines[1].evidence
    assert words.submitted in found.lines[2].evidence


def test_a_worksheet_in_cp949_is_filled_in_as_utf8(tmp_path: Path) -> None:
    sheet = read_worksheet(worksheet(people(3, korean=True), KOREAN, encoding="cp949"))
    assert sheet.sheet.filled({}).decode("utf-8-sig").startswith("식별자,전체 이름")
    assert "CP949" in sheet.notes[0]


def test_columns_with_unknown_names_are_recognised_by_content(tmp_path: Path) -> None:
    class_ = [replace(p, submitted=n != 2) for n, p in enumerate(people(5))]
    (tmp_path / "roster.csv").write_bytes(worksheet(class_, FINNISH))
    found = read_roster(tmp_path / "roster.csv")
    assert found.system is SYSTEMS["moodle"]
    assert found.students == tuple(
        Student(str(p.number), p.name, p.email, "", p.id_number) for p in class_
    )
    (note,) = found.notes
    for taken in ("'Tunniste' as key", "'Koko nimi' as name", "'Osoite' as email"):
        assert taken in note
    # without a submission time there is no submission
    assert [bool(line.evidence) for line in found.lines] == [True, True, False, True, True]


def test_line_numbers_are_not_student_ids(tmp_path: Path) -> None:
    found = roster(tmp_path, "Lp,Nazwisko i imię\n1,Ann Lee\n2,Ben Ray\n")
    assert [(one.key, one.name) for one in found.students] == [
        ("Ann Lee", "Ann Lee"),
        ("Ben Ray", "Ben Ray"),
    ]


@pytest.mark.parametrize(
    ("content", "output"),
    [
        ("Sarake,Toinen\n5,x\n6,x\n", "no column identifies a student"),
        ("김민지,2024001,kim@school.kr\n이서연,2024002,lee@school.kr\n", "first line must name"),
        ("Kim Minji,kim@school.kr\nLee Seoyeon,lee@school.kr\n", "first line must name"),
    ],
)
def test_a_roster_without_known_columns_is_an_error(
    tmp_path: Path, content: str, output: str
) -> None:
    with pytest.raises(UsageError, match=rf"roster.csv:1: .*{output}"):
        roster(tmp_path, content)


@pytest.mark.parametrize(
    ("status", "on", "submitted"),
    [
        ("Submitted for grading - 2 hours late - Graded", "-", True),
        ("No submission - Assignment is overdue by: 2 days", "-", False),
        ("Draft (not submitted)", "Friday, 20 November 2026", False),
        ("채점을 위해 제출되었습니다. - 2 시간 늦음", "-", True),
        ("제출 없음", "-", False),
        ("초안(제출 되지 않았음)", "2026년 11월 20일", False),
        ("Palautettu arvioitavaksi", "perjantai 20. marraskuuta 2026", True),
        ("Ei palautusta", "-", False),
        ("", "", False),
    ],
)
def test_the_status_column_says_whether_there_is_a_submission(
    status: str, on: str, submitted: bool
) -> None:
    assert says_submitted(status, on) == submitted
