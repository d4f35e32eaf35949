"""A name that several students have joins nobody and reads no grade back, in every run."""

from __future__ import annotations

import csv
import io
import shutil
import unicodedata
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from grader.base.errors import UsageError
from grader.batch.discover import discover
from grader.batch.earlier_gradebook import EarlierGradebook, read_earlier_gradebook
from grader.batch.find_student import find_student
from grader.batch.model import ClassFolder, Student
from grader.batch.sheets import SheetOptions, open_sheets
from grader.course.load import load_assignment
from tests.batch.archives import write
from tests.batch.downloads import canvas_gradebook, moodle_zip, people, scored, worksheet
from tests.batch.stub_run import Run, grade_all
from tests.processes import ROOT

HELLO = ROOT / "lab/course/hello_time/assignment.yaml"
ROSTER = """\
id,name,email
1,Same Name,one@example.org
2,Same Name,two@example.org
3,Other Person,three@example.org
"""
SAID = "Same Name: 2 students of this name (1, 2)"


def class_of(place: Path, roster: str, *folders: str) -> ClassFolder:
    for name in folders:
        write(place / "class" / name, scored(100))
    (place / "roster.csv").write_text(roster, encoding="utf-8")
    return discover(place / "class", roster=place / "roster.csv", unpack=place / "work")


@pytest.mark.prefix
def test_a_folder_of_a_name_that_two_have_is_no_grade_for_anybody_in_three_runs(
    tmp_path: Path,
) -> None:
    course = tmp_path / "course/hello_time"
    shutil.copytree(HELLO.parent, course)
    with (course / "assignment.yaml").open("a", encoding="utf-8") as file:
        file.write("\npolicy:\n  missing: zero\n")
    write(tmp_path / "class/Same Name", scored(100))
    write(tmp_path / "class/Other Person", scored(90))
    roster = tmp_path / "roster.csv"
    roster.write_text(ROSTER, encoding="utf-8")
    words: Sequence[str | Path] = ("--roster", roster, "--assignment", course / "assignment.yaml")
    runs = [grade_all(tmp_path / "class", tmp_path / "out", *words) for _ in range(3)]
    assert [run.status for run in runs] == [1] * 3, runs[0].output
    assert [run.output.count(SAID) for run in runs] == [1] * 3, "said once in every run"
    for run in (*runs, regraded(runs[0], words)):
        finals = run.column("gradebook.csv", "final", "key")
        assert finals == {"1": "", "2": "", "Other Person": "90", "Same Name": ""}
    page = (tmp_path / "out/index.html").read_text(encoding="utf-8")
    assert page.count(SAID) == 1
    attention = page.partition("Needs attention</h2>")[2]
    assert attention.index("<h3>") < attention.index(SAID) < attention.index("</ul>"), "it is first"
    assert sorted(path.stem for path in (tmp_path / "out/feedback").glob("*.md")) == [
        next(p.stem for p in (tmp_path / "out/feedback").glob("Other*.md"))
    ]


def regraded(run: Run, words: Sequence[str | Path]) -> Run:
    """Write all files again: nothing is read back from the gradebook that is there."""
    return grade_all(run.out.parent / "class", run.out, *words, "--regrade")


@pytest.mark.parametrize(
    "folder",
    [
        "Name, Same",
        "same_name",
        "SAME NAME",
        "SameName",
        "Ｓａｍｅ Ｎａｍｅ",
        unicodedata.normalize("NFD", "Sámé Name"),
    ],
)
def test_other_ways_to_write_the_name_are_the_same_name(tmp_path: Path, folder: str) -> None:
    found = class_of(tmp_path, ROSTER, folder, "Other Person")
    (unclear,) = [one for one in found.handed_in if one.unclear]
    assert unclear.student.email == ""
    assert all(found.elsewhere[student.key].is_unclear for student in found.missing)
    assert len(found.missing) == 2


def test_korean_names_with_and_without_a_blank_are_one_name(tmp_path: Path) -> None:
    found = class_of(tmp_path, "id,name\n1,김민지\n2,김 민지\n", "김민지")
    assert [one.student.id_number for one in found.handed_in] == [""]
    assert "2 students of this name (1, 2)" in found.unclear[0]


@pytest.mark.parametrize("folders", [("1", "2"), ("one@example.org", "2"), ("one", "two")])
def test_an_id_or_an_email_address_still_tells_them_apart(
    tmp_path: Path, folders: tuple[str, str]
) -> None:
    found = class_of(tmp_path, ROSTER, *folders)
    assert [one.student.id_number for one in found.handed_in] == ["1", "2"]
    assert not found.unclear


def test_who_is_left_over_is_not_joined_by_name(tmp_path: Path) -> None:
    """The folder may also be another attempt of the student who is already joined by number."""
    found = class_of(tmp_path, ROSTER, "1", "Same Name", "Other Person")
    assert {one.student.key: one.student.id_number for one in found.handed_in} == {
        "1": "1",
        "Same Name": "",
        "Other Person": "3",
    }
    assert [student.id_number for student in found.missing] == ["2"]
    assert found.elsewhere["2"].is_unclear


def test_a_roster_of_names_only_has_a_key_for_each_student(tmp_path: Path) -> None:
    found = class_of(tmp_path, "name\nSame Name\nSame Name\nOther Person\n", "Same Name")
    keys = [student.key for student in found.missing]
    assert len(set(keys)) == 3
    assert "Same Name" not in keys


def sheets(place: Path, name: str, content: bytes) -> SheetOptions:
    path = place / f"{name}.csv"
    path.write_bytes(content)
    return SheetOptions(files={name: path})


@pytest.mark.parametrize("option", ["worksheet", "canvas"])
def test_no_grade_is_read_from_a_sheet_by_a_shared_name(tmp_path: Path, option: str) -> None:
    """The row may be the other student's: only one of them is in the sheet."""
    person = replace(people(1)[0], name="Same Name", number=7, email="", id_number="", grade="80")
    content = {"worksheet": worksheet([person]), "canvas": canvas_gradebook([person])}[option]
    opened = open_sheets(sheets(tmp_path, option, content), load_assignment(HELLO))
    found = class_of(tmp_path, ROSTER, "1", "Other Person")
    class_ = [*(one.student for one in found.handed_in), *found.missing]
    assert opened.elsewhere(class_, found.system) == {}
    alone = [student for student in class_ if student.key != "1"]
    assert opened.elsewhere(alone, found.system).keys() == {"2"}, "a name that one has does"


def test_two_participants_of_one_name_are_joined_by_moodles_number(tmp_path: Path) -> None:
    one, two, other = (replace(p, name=n) for p, n in zip(people(3), ("Kim", "Kim", "Lee")))
    path = moodle_zip(tmp_path / "c.zip", [("Kim", two.number, scored(90))])
    (tmp_path / "w.csv").write_bytes(worksheet([replace(one, submitted=False), two, other]))
    found = discover(path, roster=tmp_path / "w.csv", unpack=tmp_path / "work")
    assert [given.student.email for given in found.handed_in] == [two.email]
    assert not found.unclear
    assert one.email in [student.email for student in found.missing]
    assert str(one.number) not in found.elsewhere


def earlier(place: Path, *rows: dict[str, str]) -> EarlierGradebook:
    out = io.StringIO()
    names = ["key", "name", "email", "username", "id_number", "status", "final"]
    table = csv.DictWriter(out, names, restval="")
    table.writeheader()
    table.writerows(rows)
    (place / "gradebook.csv").write_text(out.getvalue(), encoding="utf-8")
    return read_earlier_gradebook(place / "gradebook.csv")


def test_our_own_gradebook_is_read_by_a_name_only_if_nobody_else_has_it(tmp_path: Path) -> None:
    one, two = Student("1", "Same Name", "one@x.y"), Student("2", "Same Name", "two@x.y")
    row = {"key": "Same Name", "name": "Same Name", "status": "graded", "final": "100"}
    book = earlier(tmp_path, row)
    assert book.elsewhere([one], [one])["1"].final == 100
    assert book.elsewhere([one, two], [one, two]) == {}
    assert book.elsewhere([two], [one, two]) == {}, "the other one is in the class"
    # the other one is only in the gradebook, without a grade
    book = earlier(tmp_path, row, {**row, "key": "9", "name": "Name Same", "final": ""})
    assert book.elsewhere([one], [one]) == {}
    # the same name with another address is somebody else
    book = earlier(tmp_path, {**row, "email": "two@x.y"})
    assert book.elsewhere([one], [one]) == {}
    assert book.elsewhere([one, two], [one, two]).keys() == {"2"}, "an address tells them apart"


@pytest.mark.parametrize("word", ["Same Name", "same name", "Name Same", "SameName"])
def test_a_correction_by_a_shared_name_is_refused(word: str) -> None:
    folder = Student("Same Name", "Same Name")
    one, two = Student("1", "Same Name", "one@x.y"), Student("2", "Same Name", "two@x.y")
    class_ = [folder, one, two, Student("3", "Other Person")]
    if word in ("Same Name", "same name"):
        with pytest.raises(UsageError, match=r"fits more than one student: Same Name .*, 1 .*, 2"):
            find_student(word, class_)
    else:
        with pytest.raises(UsageError):
            find_student(word, class_)
    assert find_student("1", class_) is one
    assert find_student("two@x.y", class_) is two
    assert find_student(unicodedata.normalize("NFD", "Zoë"), [Student("4", "Zoë")]).key == "4"
