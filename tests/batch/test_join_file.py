"""The join is shown before the marking, and its CSV file is corrected and given back."""

from __future__ import annotations

import csv
import io
import shutil
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pexpect
import pytest

from grader.base.errors import UsageError
from grader.batch.discover import discover
from grader.batch.join_file import GivenJoin, file_names, join_csv, join_rows
from grader.batch.model import ClassFolder
from grader.batch.roster import Roster, read_roster
from tests.batch.archives import write
from tests.batch.downloads import moodle_zip, of_people, people, scored, worksheet
from tests.batch.stub_run import Run, grade_all
from tests.processes import ROOT

ROSTER = """\
id,name,email
1,Same Name,one@example.org
2,Same Name,two@example.org
3,Other Person,three@example.org
4,Absent Person,four@example.org
"""
FOLDERS = {"Same Name": 80, "Other Person": 90, "sunny": 70}


@pytest.fixture
def place(tmp_path: Path) -> Path:
    for name, score in FOLDERS.items():
        write(tmp_path / "class" / name, scored(score))
    (tmp_path / "roster.csv").write_text(ROSTER, encoding="utf-8")
    return tmp_path


def found(place: Path, join: str | bytes | None = None) -> ClassFolder:
    given = None
    if join is not None:
        path = place / "corrected.csv"
        path.write_bytes(join if isinstance(join, bytes) else join.encode())
        given = GivenJoin(path)
    return discover(
        place / "class", roster=place / "roster.csv", unpack=place / "work", given=given
    )


def owners(folder: ClassFolder) -> dict[str, str]:
    """Return the id number of each file's student, "" if it has none."""
    return {one.path.name: one.student.id_number for one in folder.handed_in}


def rows_of(content: bytes) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(content.decode("utf-8-sig"), newline="")))


def test_the_file_says_what_is_sure_unsure_strange_and_missing(place: Path) -> None:
    rows = rows_of(join_csv(join_rows(found(place))))
    assert [(row["file"], row["student"], row["joined"]) for row in rows] == [
        ("Other Person", "three@example.org", "by name"),
        ("Same Name", "", "unsure"),
        ("sunny", "", "stranger"),
        ("", "one@example.org", "unsure"),
        ("", "two@example.org", "unsure"),
        ("", "four@example.org", "missing"),
    ]
    assert "2 students of this name" in rows[1]["why"]


def test_given_back_as_it_is_it_changes_nothing(place: Path) -> None:
    before = found(place)
    again = found(place, join_csv(join_rows(before)))
    assert owners(again) == owners(before)
    assert again.missing == before.missing
    assert again.elsewhere == before.elsewhere
    assert [one.student.key for one in again.handed_in] == [
        one.student.key for one in before.handed_in
    ]


def test_corrections_count_and_a_file_can_be_left_out(place: Path) -> None:
    folder = found(place, "file;student\nSame Name;2\nsunny;-\n")
    assert owners(folder) == {"Same Name": "2", "Other Person": "3"}
    assert [student.id_number for student in folder.missing] == ["1", "4"]
    assert not folder.unclear
    assert not folder.elsewhere
    assert ("sunny", "-", "left out") in {
        (row.file, row.student, row.joined) for row in join_rows(folder)
    }
    again = found(place, join_csv(join_rows(folder)))
    assert owners(again) == owners(folder), "a corrected file is written as it was corrected"


def test_several_rows_of_a_file_are_a_group_and_several_files_are_attempts(place: Path) -> None:
    folder = found(place, "file,student\nsunny,1\nsunny,2\nSame Name,1\n")
    who = sorted((one.student.id_number, one.path.name) for one in folder.handed_in)
    assert who == [("1", "Same Name"), ("1", "sunny"), ("2", "sunny"), ("3", "Other Person")]
    first = {one.student.key for one in folder.handed_in if one.student.id_number == "1"}
    assert len(first) == 1, "both are attempts of one student"
    again = found(place, join_csv(join_rows(folder)))
    assert sorted((one.student.id_number, one.path.name) for one in again.handed_in) == who


@pytest.mark.parametrize(
    ("join", "said"),
    [
        ("file,student\nsunny,Other Persom\n", [":2: ", "'Other Persom'", "'Other Person'"]),
        ("file,student\nsunny,Same Name\n", [":2: ", "more than one student", "1", "2"]),
        ("file,student\n\nsuny,1\n", [":3: ", "no submission 'suny'", "did you mean 'sunny'"]),
        ("file,student\nsunny,1\nsunny,one@example.org\n", [":3: ", "line 2 says the same"]),
        ("file,student\nsunny,1\nsunny,-\n", [":3: ", "line 2 contradict"]),
        ("fil,student\nsunny,1\n", [":1: ", "no column 'file'", "is it 'fil'"]),
        ("file,student,student\nsunny,1,2\n", [":1: ", "several columns 'student'"]),
        ("file,student\nsuny,1\nsunny,9\n", [":2: ", "suny", "\n", ":3: ", "'9'"]),
    ],
)
def test_an_error_has_its_line_and_what_is_meant(
    place: Path, join: str, said: Sequence[str]
) -> None:
    with pytest.raises(UsageError) as error:
        found(place, join)
    text = str(error.value)
    for word in said:
        assert word in text
        text = text.partition(word)[2]


def test_students_cannot_be_named_without_a_roster(place: Path) -> None:
    (place / "join.csv").write_text("file,student\nsunny,1\n")
    given = GivenJoin(place / "join.csv")
    with pytest.raises(UsageError, match="no list of the class"):
        discover(place / "class", unpack=place / "work", given=given)


def test_a_roster_of_names_only_tells_its_namesakes_apart(place: Path) -> None:
    (place / "roster.csv").write_text("name\nSame Name\nSame Name\nOther Person\n")
    folder = found(place, "file,student\nSame Name,Same Name (line 3)\n")
    again = found(place, join_csv(join_rows(folder)))
    assert [student.key for student in folder.missing] == ["Same Name (line 2)"]
    assert again.missing == folder.missing


@pytest.mark.parametrize("encoding", ["utf-16", "cp949"])
def test_names_in_other_encodings_are_read(tmp_path: Path, encoding: str) -> None:
    write(tmp_path / "class" / "과제 1", scored(80))
    write(tmp_path / "class" / "김민지", scored(80))
    (tmp_path / "roster.csv").write_text("학번,이름\n1,이서연\n2,김민지\n", encoding="utf-8")
    join = "sep=;\nfile;student\n과제 1;이서연\n".encode(encoding)
    assert owners(found(tmp_path, join)) == {"과제 1": "1", "김민지": "2"}


@pytest.mark.parametrize("name", ["=cmd|calc", "-", "@a; =b", "김 민지", 'a,b "c"', "two\nlines"])
def test_every_name_of_a_file_is_recognised_again(tmp_path: Path, name: str) -> None:
    write(tmp_path / "class" / name, scored(80))
    write(tmp_path / "class" / "Other", scored(80))
    (tmp_path / "roster.csv").write_text("id,name\n1,Ann\n2,Other\n", encoding="utf-8")
    before = rows_of(join_csv(join_rows(found(tmp_path))))
    (row,) = [row for row in before if row["joined"] == "stranger"]
    out = io.StringIO()
    csv.writer(out).writerows([("file", "student"), (row["file"], "1")])
    assert owners(found(tmp_path, out.getvalue())) == {name: "1", "Other": "2"}


def test_a_moodle_download_with_groups_is_joined_again_as_it_was(tmp_path: Path) -> None:
    names = ["Blue", "Blue", "Red", "Red"]
    class_ = [replace(one, group=name) for one, name in zip(people(4), names, strict=True)]
    (tmp_path / "roster.csv").write_bytes(worksheet(class_))
    folders = [("Blue", 7, scored(90)), ("Red", 8, scored(80))]
    path = moodle_zip(tmp_path / "class.zip", folders)

    def joined(given: GivenJoin | None) -> ClassFolder:
        roster = tmp_path / "roster.csv"
        return discover(path, roster=roster, unpack=tmp_path / "work", given=given)

    before = joined(None)
    assert len(before.handed_in) == 4
    (tmp_path / "join.csv").write_bytes(join_csv(join_rows(before)))
    again = joined(GivenJoin(tmp_path / "join.csv"))
    assert [(one.student, one.path) for one in again.handed_in] == [
        (one.student, one.path) for one in before.handed_in
    ]
    assert again.missing == before.missing == ()


def test_moodles_worksheet_leads_from_its_numbers_to_the_addresses_of_a_roster(
    tmp_path: Path,
) -> None:
    class_ = [replace(one, name="Kim Minjun") for one in people(2)]
    rows = [f"Kim Minjun,{one.email},{section}" for one, section in zip(class_, "BA", strict=True)]
    (tmp_path / "roster.csv").write_text("\n".join(["name,email,section", *rows, ""]))
    (tmp_path / "worksheet.csv").write_bytes(worksheet(class_))
    path = moodle_zip(tmp_path / "class.zip", of_people(class_))
    known = read_roster(tmp_path / "worksheet.csv")

    def joined(*lists: Roster) -> ClassFolder:
        roster = tmp_path / "roster.csv"
        return discover(path, roster=roster, unpack=tmp_path / "work", lists=lists)

    assert not any(one.student.section for one in joined().handed_in)
    both = joined(known)
    assert (both.missing, [one.unclear for one in both.handed_in]) == ((), ["", ""])
    for person, section in zip(class_, "BA", strict=True):
        (one,) = [one for one in both.handed_in if f"_{person.number}_" in str(one.path)]
        assert (one.student.email, one.student.section) == (person.email, section)


def test_files_of_one_name_have_their_folders_name_too() -> None:
    paths = [Path("/a/x/one"), Path("/a/y/one"), Path("/a/x/two")]
    assert list(file_names(paths).values()) == ["two", "x/one", "y/one"]


def finals(run: Run) -> dict[str, str]:
    rows = run.rows()
    return {row["id_number"] or row["key"]: row["final"] for row in rows}


@pytest.mark.prefix
def test_every_run_says_the_join_and_a_corrected_one_stays(place: Path) -> None:
    words: Sequence[str | Path] = ("--roster", place / "roster.csv", "--accept", "join")
    out = place / "out"
    dry = grade_all(place / "class", out, *words, "--dry-run", quiet=False)
    assert dry.status == 0, dry.output
    for said in (
        "unsure, nobody gets a grade (3):\n  Same Name → ?",
        "not on the roster (1):\n  sunny → ?",
        "joined by name only (1):\n  Other Person → Other Person (three@example.org)",
        "without a submission (1):\n  Absent Person (four@example.org)",
    ):
        assert said in dry.output, dry.output
    assert not (out / "gradebook.csv").exists()
    first = grade_all(place / "class", out, *words)
    assert "unsure, nobody gets a grade" in first.output
    assert finals(first)["1"] == ""
    join = (out / "join.csv").read_text(encoding="utf-8-sig")
    corrected = place / "mine.csv"
    corrected.write_text(join.replace('"Same Name",""', '"Same Name","1"', 1), encoding="utf-8")
    second = grade_all(place / "class", out, *words, "--join", corrected)
    assert finals(second)["1"] == "80", second.output
    third = grade_all(place / "class", out, *words)
    assert finals(third)["1"] == "80", "a run that forgets the option keeps the grade"
    assert "--join as given earlier" in third.output
    without = grade_all(place / "class", out, "--accept", "lower")
    assert without.status in (0, 1), "no roster, no students to name: nothing is refused"


@pytest.mark.prefix
def test_a_run_says_which_grades_change(place: Path) -> None:
    words: Sequence[str | Path] = ("--roster", place / "roster.csv", "--accept", "join")
    out = place / "out"
    grade_all(place / "class", out, *words)
    write(place / "class" / "Other Person", scored(95))
    dry = grade_all(place / "class", out, *words, "--dry-run")
    assert "1 grade can change, because a submission is to be marked:\n  Other Person" in dry.output
    assert finals(dry)["3"] == "90"
    sheet = "\n".join(
        (
            "Identifier,Full name,Email address,Status,Grade,Last modified (grade)",
            "Participant 3,Other Person,three@example.org,Submitted for grading,50.00,-",
            "",
        )
    )
    (place / "worksheet.csv").write_text(sheet, encoding="utf-8")
    shutil.copytree(place / "class/Other Person", place / "one/Other Person")
    words = ("--worksheet", place / "worksheet.csv")
    grade_all(place / "one", place / "other", *words)
    dry = grade_all(place / "one", place / "other", *words, "--dry-run")
    assert (
        "1 grade will change:\n  Other Person: 50.00 → 95 (in the Moodle worksheet)" in dry.output
    )


@pytest.mark.prefix
def test_a_refused_join_is_shown_so_that_it_can_be_corrected(place: Path) -> None:
    run = grade_all(place / "class", place / "out", "--roster", place / "roster.csv")
    assert run.status == 2
    assert run.output.index("not on the roster (1):\n  sunny → ?") < run.output.index("only 2 of 3")
    join = (place / "out/join.csv").read_text(encoding="utf-8-sig")
    assert '"sunny",""' in join
    corrected = place / "mine.csv"
    corrected.write_text(join.replace('"sunny",""', '"sunny","four@example.org"'), encoding="utf-8")
    words: Sequence[str | Path] = ("--roster", place / "roster.csv", "--join", corrected)
    again = grade_all(place / "class", place / "out", *words)
    assert finals(again)["4"] == "70", again.output


@pytest.mark.prefix
def test_a_terminal_asks_before_a_long_run(tmp_path: Path) -> None:
    for number in range(25):
        write(tmp_path / "class" / f"student {number}", scored(100))
    words = ["-m", "tests.batch.stub_run", "grade-all", str(tmp_path / "class")]
    words += ["--out", str(tmp_path / "out"), "--sandbox", "bubblewrap", "--workers", "1"]
    for answer, marks in (("\n", False), ("n\n", False), ("\x04", False), ("y\n", True)):
        child = pexpect.spawn(sys.executable, words, cwd=ROOT, encoding="utf-8", timeout=120)
        child.expect(r"mark 25 submissions \(about 1 min 15 s\)\? \[y/N\] ")
        child.send(answer)
        child.expect(pexpect.EOF)
        child.close()
        assert child.exitstatus == 0, child.before
        assert ("nothing was marked" in child.before) is not marks
        assert (tmp_path / "out/gradebook.csv").exists() is marks
    words[words.index("--out") + 1] = str(tmp_path / "other")
    child = pexpect.spawn(
        sys.executable, [*words, "--yes"], cwd=ROOT, encoding="utf-8", timeout=120
    )
    child.expect(pexpect.EOF)
    assert "[y/N]" not in child.before
    assert (tmp_path / "other/gradebook.csv").exists()
