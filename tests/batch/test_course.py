"""A course: its lessons with due dates and weights, one gradebook, workbooks in and out."""

from __future__ import annotations

import io
from pathlib import Path

import pytest
from openpyxl import Workbook, load_workbook

from grader.base.errors import AssignmentError, UsageError
from grader.batch.course_file import read_course
from grader.batch.course_result import LessonResult, course_result
from grader.batch.model import ClassResult, GradebookEntry, Student
from grader.batch.roster import read_roster
from grader.batch.systems.known import SYSTEMS
from grader.batch.xlsx import as_csv, workbook
from grader.publish.course_gradebook import course_table, course_xlsx
from tests.batch.archives import write
from tests.batch.downloads import scored
from tests.batch.stub_run import Run, grade_all
from tests.processes import ROOT

ANN = Student("a1", "Ann Lee", email="ann@example.org")
ROSTER = "id,name,email,section\n1,Ann Lee,ann@example.org,A\n2,Bob Ray,bob@example.org,B\n"


def lesson(name: str, weight: float, *entries: tuple[Student, float | None]) -> LessonResult:
    made = tuple(
        GradebookEntry(one, "graded" if final is not None else "missing", final=final, max_score=50)
        for one, final in entries
    )
    return LessonResult(name, weight, ClassResult(name, name, SYSTEMS["folders"], made, 50), name)


def test_students_are_joined_across_lessons_and_weighted() -> None:
    first = lesson("one", 1, (ANN, 50), (Student("b1", "Bob Ray"), 25))
    second = lesson(
        *("two", 3),
        (Student("77", "Lee, Ann", email="ANN@example.org"), 25),
        (Student("78", "Bob Ray", id_number="9"), None),
        (Student("79", "Cleo Poe"), 40),
    )
    course = course_result("ROS", [first, second])
    table = course_table(course)
    assert table[0] == [
        *("name", "email", "username", "id_number", "section", "one", "two"),
        *("percent", "graded", "without a grade"),
    ]
    by_name = {row[0]: row[5:] for row in table[3:]}
    # (50/50 * 1 + 25/50 * 3) / 4
    assert by_name["Ann Lee"] == [50, 25, 62.5, 2, ""]
    assert by_name["Bob Ray"] == [25, None, 50, 1, "two: nothing handed in"]
    assert by_name["Cleo Poe"] == [None, 40, 80, 1, "one: not in this class"]


def test_a_name_of_several_joins_nobody() -> None:
    same = [Student("1", "Same Name", email="x@y.org"), Student("2", "Same Name", email="z@y.org")]
    first = lesson("one", 1, (same[0], 10), (same[1], 20))
    second = lesson("two", 1, (Student("f", "Same Name"), 30))
    third = lesson("three", 1, (Student("g", "Same Name", email="z@y.org"), 40))
    rows = course_table(course_result("ROS", [first, second, third]))[3:]
    assert [row[5:8] for row in rows] == [[10, None, None], [20, None, 40], [None, 30, None]]
    assert "two: not joined, because several have this name" in str(rows[2][-1])


def test_a_workbook_has_numbers_and_no_formula() -> None:
    evil = Student("e", "=1+1\x07", section="+cmd")
    content = course_xlsx(course_result("ROS", [lesson("one", 1, (evil, 12.5))]))
    assert content == course_xlsx(course_result("ROS", [lesson("one", 1, (evil, 12.5))]))
    sheet = load_workbook(io.BytesIO(content)).active
    assert [cell.data_type for cell in sheet[4]][:6] == ["s", "n", "n", "n", "s", "n"]
    assert sheet["F4"].value == 12.5
    assert sheet["A4"].value.startswith("'=1+1")


def test_a_workbook_is_read_as_a_roster(tmp_path: Path) -> None:
    book = Workbook()
    for row in (
        ["학번", "이름", "이메일"],
        [2026001, "김민지", "minji@example.org"],
        [None, None, None],
    ):
        book.active.append(row)
    book.create_sheet("more")
    book.save(tmp_path / "roster.xlsx")
    roster = read_roster(tmp_path / "roster.xlsx")
    (student,) = roster.students
    assert (student.id_number, student.name, student.email) == (
        *("2026001", "김민지"),
        "minji@example.org",
    )
    assert any("only its first sheet" in note for note in roster.notes)
    again, _ = as_csv(workbook({"a": [["x", "y"], ["007", 3.5]]}), "it")
    assert again.decode().split() == ["x,y", "007,3.5"]
    with pytest.raises(UsageError, match=r"cannot be read as an \.xlsx file"):
        as_csv(b"PK\x03\x04", "it")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("schema: 1\nlessons: {}\n", "lessons"),
        ("schema: 1\nlessons:\n  a: {wieght: 2}\n", "did you mean 'weight'"),
        ("schema: 1\nlessons:\n  a: {due: 2026-11-20 18:00:00}\n", "no time zone"),
        ("schema: 1\nlessons:\n  a: {worksheet: none.csv}\n", "there is no file"),
        ("schema: 1\nroster: none.csv\nlessons:\n  a:\n", "there is no file"),
        ("schema: 1\nlessons:\n  a: {submissions: gone}\n", "there is no folder or archive"),
    ],
)
def test_a_fault_of_the_file_has_its_place(tmp_path: Path, text: str, said: str) -> None:
    (tmp_path / "course.yaml").write_text(text)
    with pytest.raises(AssignmentError) as error:
        read_course(tmp_path / "course.yaml")
    assert said in str(error.value).replace("Did", "did")
    assert "course.yaml:" in str(error.value)


@pytest.mark.prefix
def test_two_lessons_give_one_gradebook(tmp_path: Path) -> None:
    """The first lesson was marked by itself before: its ledger goes on."""
    for week, scores in (("week1", (60, 100)), ("week2", (80, 40))):
        for name, score in zip(("Ann Lee", "Bob Ray"), scores):
            write(tmp_path / "all" / week / name, scored(score))
    (tmp_path / "roster.csv").write_text(ROSTER)
    before = grade_all(tmp_path / "all/week1", tmp_path / "old")
    assert before.finals() == {"Ann Lee": "60", "Bob Ray": "100"}
    hello = ROOT / "lab/course/hello_time/assignment.yaml"
    file = tmp_path / "autumn.yaml"
    file.write_text(
        "schema: 1\ntitle: ROS 2, autumn\nroster: roster.csv\nlessons:\n"
        f"  week1: {{assignment: {hello}, out: old}}\n"
        f"  week2: {{assignment: {hello}, weight: 3, due: 2026-11-20T23:59:00+09:00}}\n"
        f"  week3: {{assignment: {hello}}}\n"
    )
    run = grade_all(tmp_path / "all", tmp_path / "out", "--course", file, "--dry-run")
    assert not (tmp_path / "out/course.csv").exists()
    run = grade_all(tmp_path / "all", tmp_path / "out", "--course", file)
    assert run.status == 1, run.output
    assert "0 to mark, 2 marked before" in run.output, "the ledger of the first lesson goes on"
    assert "no submissions yet: week3" in run.output
    rows = {row["name"]: row for row in run.rows("course.csv")}
    assert [rows["weight"][week] for week in ("week1", "week2")] == ["1", "3"]
    ann = rows["Ann Lee"]
    assert (ann["week1"], ann["week2"], ann["percent"], ann["section"]) == ("60", "80", "75", "A")
    page = (tmp_path / "out/index.html").read_text(encoding="utf-8")
    assert 'href="../old/students/' in page
    assert 'href="week2/students/' in page
    week2 = Run(0, "", tmp_path / "out/week2")
    assert {row["due"] for row in week2.rows()} == {"2026-11-20T14:59:00+00:00"}
    both = grade_all(tmp_path / "all", tmp_path / "out", "--course", file, "--roster", file)
    assert both.status == 2
    assert "with --course, --roster cannot be given" in both.output
