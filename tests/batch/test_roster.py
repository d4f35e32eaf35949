"""The roster of a class, and how submissions are matched with it."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from grader.base.errors import UsageError
from grader.batch.discover import discover
from grader.batch.model import ClassFolder, HandedIn, Student
from grader.batch.roster import Roster, read_roster
from grader.batch.systems.known import SYSTEMS

from .archives import package, repository, write

MOODLE = """\
Identifier,Full name,ID number,Email address,Status,Group,Grade,Maximum Grade,Last modified (grade)
Participant 11,Ann Lee,4711,ann@school.edu,No submission,Blue,,100.00,-
Participant 12,Zoë Roe,4712,zoe@school.edu,Submitted,Red,,100.00,-
"""
CANVAS = """\
Student,ID,SIS User ID,SIS Login ID,Section,Hello (77)
    Points Possible,,,,,100
"Lee, Ann",101,4711,alee,Lab 1,
"Roe, Zoë",102,4712,zroe,Lab 2,
"Student, Test",999,,,Lab 1,
"""
GRADESCOPE = """\
First Name,Last Name,SID,Email,Sections
Ann,Lee,4711,ann@school.edu,Lab 1
Zoë,Roe,,zoe@school.edu,
"""
CLASSROOM = """\
"identifier","github_username","github_id","name"
"ann@school.edu","ann-lee","1",""
"zroe","zoe","2","Zoë Roe"
"""


def roster(tmp_path: Path, content: str | bytes, name: str = "roster.csv") -> Roster:
    data = content.encode() if isinstance(content, str) else content
    (tmp_path / name).write_bytes(data)
    return read_roster(tmp_path / name)


def test_moodles_worksheet_is_read_with_participant_numbers(tmp_path: Path) -> None:
    found = roster(tmp_path, MOODLE)
    assert found.system is SYSTEMS["moodle"]
    assert found.students == (
        Student("11", "Ann Lee", "ann@school.edu", "", "4711", "Blue"),
        Student("12", "Zoë Roe", "zoe@school.edu", "", "4712", "Red"),
    )
    assert not found.notes


def test_moodles_worksheet_in_another_language_is_read_too(tmp_path: Path) -> None:
    found = roster(
        tmp_path,
        "Identifikator;Vollständiger Name;E-Mail-Adresse;Bewertung\r\n"
        "Teilnehmer/in12;Zoë Roe;zoe@school.edu;\r\n",
    )
    assert found.system is SYSTEMS["moodle"]
    assert found.students == (Student("12", "Zoë Roe", "zoe@school.edu"),)
    found = roster(tmp_path, "Идентификатор,Имя,Почта\nУчастник 3,Анна Ли,anna@school.edu\n")
    assert found.students == (Student("3", "Анна Ли", "anna@school.edu"),)


def test_canvas_gradebook_is_read_without_points_row_and_test_student(tmp_path: Path) -> None:
    found = roster(tmp_path, CANVAS)
    assert found.system is SYSTEMS["canvas"]
    assert found.students == (
        Student("101", "Ann Lee", "", "alee", "4711", "Lab 1"),
        Student("102", "Zoë Roe", "", "zroe", "4712", "Lab 2"),
    )
    assert "lines without a student: 2, 5" in found.notes[0]


def test_gradescopes_and_classrooms_rosters_are_read(tmp_path: Path) -> None:
    assert roster(tmp_path, GRADESCOPE).students == (
        Student("4711", "Ann Lee", "ann@school.edu", "", "4711", "Lab 1"),
        Student("zoe@school.edu", "Zoë Roe", "zoe@school.edu"),
    )
    assert roster(tmp_path, CLASSROOM).students == (
        Student("ann-lee", "ann@school.edu", "ann@school.edu", "ann-lee"),
        Student("zroe", "Zoë Roe", "", "zoe", "zroe"),
    )


@pytest.mark.parametrize(
    ("header", "row", "student"),
    [
        (
            "id,name,email,username",
            "1,Ann Lee,a@b.c,al",
            Student("1", "Ann Lee", "a@b.c", "al", "1"),
        ),
        ("Username", "al", Student("al", "al", "", "al")),
        ("Name", "Ann Lee", Student("Ann Lee", "Ann Lee")),
        ("Surname;Given name", "Lee;Ann", Student("Ann Lee", "Ann Lee")),
        ("NAME\tE-Mail", "Lee, Ann\ta@b.c", Student("a@b.c", "Ann Lee", "a@b.c")),
        ("Who,Where,Student_ID", "x,a@b.c,0042", Student("0042", "0042", "a@b.c", "", "0042")),
        (" Full Name , Section ", " Ann  Lee , B ", Student("Ann  Lee", "Ann  Lee", section="B")),
    ],
)
def test_columns_are_recognised_by_common_names(
    tmp_path: Path, header: str, row: str, student: Student
) -> None:
    assert roster(tmp_path, f"{header}\n{row}\n").students == (student,)


@pytest.mark.parametrize(
    ("encoding", "noted"),
    [
        ("utf-8", False),
        ("utf-8-sig", False),
        ("utf-16", False),
        ("latin-1", True),
        ("cp1252", True),
    ],
)
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_every_common_encoding_is_read(
    tmp_path: Path, encoding: str, noted: bool, end: str
) -> None:
    text = f"name,email{end}Zoë Roe,zoe@school.edu{end}{end}"
    found = roster(tmp_path, text.encode(encoding))
    assert found.students == (Student("zoe@school.edu", "Zoë Roe", "zoe@school.edu"),)
    assert bool(found.notes) == noted


def test_excels_sep_line_is_skipped(tmp_path: Path) -> None:
    found = roster(tmp_path, "sep=;\nname;email\nAnn Lee;a@b.c\n")
    assert found.students == (Student("a@b.c", "Ann Lee", "a@b.c"),)
    with pytest.raises(
        UsageError, match=r"roster.csv:4: the email address 'A@b.c' is also in line 3"
    ):
        roster(tmp_path, "sep=;\nname;email\nAnn Lee;a@b.c\nJoe;A@b.c\n")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("", "is empty"),
        ("name,email\n", r"roster.csv:1: there are no students"),
        ("nmae,grade\nAnn,5\n", r"roster.csv:1: no column .*'nmae'.*did you mean 'name'"),
        ("a,b\n1,2\n", r"roster.csv:1: no column identifies a student: 'a', 'b'"),
        (
            'name,id\nAnn,1\n\n"J\noe",2\nMax,1\n',
            r"roster.csv:6: the id number '1' is also in line 2",
        ),
        (
            MOODLE + "Participant 11,Max,9,m@x.y,,,,,\n",
            r"roster.csv:4: the id '11' is also in line 2",
        ),
        (b"\xff\xfea", "UTF-16 but is not"),
        (b"a\0b", "not a CSV file"),
        (b"PK\x03\x04xl/worksheets", "cannot be read as an .xlsx file"),
    ],
)
def test_an_unusable_roster_is_reported(tmp_path: Path, content: str | bytes, message: str) -> None:
    with pytest.raises(UsageError, match=message) as error:
        roster(tmp_path, content)
    assert str(error.value).isprintable() or "\n" in str(error.value)


def test_a_missing_roster_is_a_usage_error(tmp_path: Path) -> None:
    for name in ("gone.csv", "a\0b"):
        with pytest.raises(UsageError, match="no roster"):
            read_roster(tmp_path / name)
    with pytest.raises(UsageError, match="regular file"):
        read_roster(tmp_path)


CELL = st.text(st.characters(codec="utf-8"), max_size=12)


@settings(max_examples=200, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(rows=st.lists(st.lists(CELL, min_size=1, max_size=4), max_size=5), raw=st.binary())
def test_any_roster_is_read_or_refused(
    tmp_path: Path, rows: Sequence[Sequence[str]], raw: bytes
) -> None:
    out = io.StringIO()
    csv.writer(out).writerows([["name", "email", "id"], *rows])
    for content in (out.getvalue().encode(), raw, b"name\n" + raw):
        try:
            found = roster(tmp_path, content)
        except UsageError:
            continue
        assert found.students
        for student in found.students:
            assert student.key
            assert student.name
            assert len({other.key for other in found.students if other == student}) == 1


# matching


def discovered(tmp_path: Path, names: Sequence[str], content: str) -> ClassFolder:
    for name in names:
        write(tmp_path / "class" / name, package())
    (tmp_path / "roster.csv").write_text(content)
    return discover(tmp_path / "class", roster=tmp_path / "roster.csv", unpack=tmp_path / "work")


def names_of(found: ClassFolder) -> list[tuple[str, str]]:
    return [(given.student.key, given.student.name) for given in found.handed_in]


def notes_of(given: HandedIn) -> str:
    return "\n".join(given.notes)


def test_without_a_roster_students_are_sorted_by_name(tmp_path: Path) -> None:
    for name in ("zoe", "Émile", "Ann", "ben"):
        write(tmp_path / "class" / name, package())
    found = discover(tmp_path / "class", unpack=tmp_path / "work")
    assert [given.student.key for given in found.handed_in] == ["Ann", "ben", "Émile", "zoe"]


def test_the_order_is_the_rosters_and_missing_students_are_reported(tmp_path: Path) -> None:
    found = discovered(
        tmp_path,
        ["al", "stranger", "4712"],
        "name,username,id number\nZoë Roe,zr,4712\nMax Ray,mr,4713\nAnn Lee,al,4711\n",
    )
    assert names_of(found) == [("4712", "Zoë Roe"), ("al", "Ann Lee"), ("stranger", "stranger")]
    assert found.missing == (Student("4713", "Max Ray", "", "mr", "4713"),)
    assert "not on the roster" in notes_of(found.handed_in[2])
    assert not found.handed_in[0].notes
    assert found.handed_in[1].student == Student("al", "Ann Lee", "", "al", "4711")


@pytest.mark.parametrize(
    "name", ["4711", "ALEE", "ann@School.edu", "ann", "Lee Ann", "ann_lée", "lee-ann", "AnnLee"]
)
def test_a_folder_name_may_be_any_unique_name_of_a_student(tmp_path: Path, name: str) -> None:
    found = discovered(
        tmp_path,
        [name, "other"],
        "id number,name,email,username\n4711,Ann Lée,ann@school.edu,alee\n4712,Joe Poe,j@p.q,jp\n",
    )
    assert names_of(found)[0] == (name, "Ann Lée")
    by_name = name.lower() not in ("4711", "alee", "ann@school.edu", "ann")
    assert ("by name only" in notes_of(found.handed_in[0])) == by_name


def test_a_name_shared_by_two_students_matches_neither(tmp_path: Path) -> None:
    found = discovered(
        tmp_path, ["Ann Lee", "Joe"], "name,id number\nAnn Lee,1\nLee Ann,2\nJoe,3\n"
    )
    assert names_of(found) == [("Joe", "Joe"), ("Ann Lee", "Ann Lee")]
    assert "2 students of this name (1, 2)" in found.handed_in[1].unclear
    assert found.unclear == (found.handed_in[1].unclear,)
    assert all(found.elsewhere[student.key].is_unclear for student in found.missing)
    assert [student.id_number for student in found.missing] == ["1", "2"]


def test_two_submissions_for_one_line_are_both_kept(tmp_path: Path) -> None:
    found = discovered(tmp_path, ["ann lee", "lee ann"], "name,id number\nAnn Lee,1\n")
    assert sorted(names_of(found)) == [("ann lee", "ann lee"), ("lee ann", "lee ann")]
    assert len({given.unclear for given in found.handed_in}) == 1
    assert "1 student of this name (1), 2 submissions" in found.handed_in[0].unclear
    assert found.elsewhere["1"].is_unclear


def test_a_user_name_outranks_a_full_name(tmp_path: Path) -> None:
    """A student whose user name is another student's full name is still identified correctly."""
    found = discovered(tmp_path, ["joe", "x"], "name,username\njoe,ann\nAnn Lee,joe\n")
    assert names_of(found)[0] == ("joe", "Ann Lee")


def test_only_moodles_own_number_matches_its_worksheet(tmp_path: Path) -> None:
    folders = ["Lee Ann_11_assignsubmission_file", "Max Ray_4712_assignsubmission_file"]
    found = discovered(tmp_path, folders, MOODLE)
    assert names_of(found) == [("11", "Ann Lee"), ("4712", "Max Ray")]
    assert [student.key for student in found.missing] == ["12"]
    assert found.handed_in[0].student.email == "ann@school.edu"
    assert "by name only" not in notes_of(found.handed_in[0])
    plain = discovered(tmp_path, [], "id,name\n11,Zoë Roe\n4712,Ann Lee\n")
    assert ("11", "Ann Lee") in names_of(plain)
    assert [student.name for student in plain.missing] == ["Zoë Roe"]


def test_canvas_submissions_match_by_number_or_by_compressed_name(tmp_path: Path) -> None:
    (tmp_path / "class").mkdir()
    for name in ("someoneelse_102_9001_a.zip", "leeann_555_9002_a.zip"):
        (tmp_path / "class" / name).write_bytes(b"PK\x03\x04")
    found = discovered(tmp_path, [], CANVAS)
    assert names_of(found) == [("555", "Ann Lee"), ("102", "Zoë Roe")]
    assert "by name only" in notes_of(found.handed_in[0])


def test_classroom_repositories_match_by_github_name(tmp_path: Path) -> None:
    for user in ("hw-1-ann-lee", "hw-1-zoe"):
        repository(tmp_path / "class" / user)
    found = discovered(tmp_path, [], CLASSROOM)
    assert names_of(found) == [("hw-1-ann-lee", "ann@school.edu"), ("hw-1-zoe", "Zoë Roe")]
    assert [given.student.username for given in found.handed_in] == ["ann-lee", "zoe"]


def test_a_common_prefix_of_user_names_is_not_part_of_the_assignment(tmp_path: Path) -> None:
    """`hw-ann-lee` and `hw-ann-ray` share a prefix: the roster decides where the name begins."""
    for user in ("hw-ann-lee", "hw-ann-ray"):
        repository(tmp_path / "class" / user)
    content = "identifier,github_username,name\n1,ann-ray,Ray\n2,ann-lee,Lee\n"
    found = discovered(tmp_path, [], content)
    assert names_of(found) == [("hw-ann-ray", "Ray"), ("hw-ann-lee", "Lee")]
    assert [given.student.username for given in found.handed_in] == ["ann-ray", "ann-lee"]


def test_the_key_of_a_missing_student_is_unique(tmp_path: Path) -> None:
    found = discovered(tmp_path, ["Joe Poe_7_assignsubmission_file"], "id,name\n7,Ann Lee\n")
    assert names_of(found) == [("7", "Joe Poe")]
    (ann,) = found.missing
    assert (ann.name, ann.key != "7") == ("Ann Lee", True)
