"""No submission gets an unjustified zero and no grade is lowered without consent."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from tests.batch.downloads import (
    KOREAN,
    Person,
    Words,
    canvas_gradebook,
    canvas_zip,
    marked,
    moodle_zip,
    of_people,
    people,
    scored,
    worksheet,
)
from tests.batch.stub_run import Run, grade_all
from tests.processes import ROOT

pytestmark = pytest.mark.prefix

HELLO = ROOT / "lab/course/hello_time"
FILLED = "moodle-worksheet.csv"
IMPORT = "moodle-gradebook.csv"


@pytest.fixture(scope="session")
def zero(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The assignment with a policy that gives zero for a missing submission."""
    place = tmp_path_factory.mktemp("course") / "hello_time"
    shutil.copytree(HELLO, place)
    with (place / "assignment.yaml").open("a", encoding="utf-8") as file:
        file.write("\npolicy:\n  missing: zero\n")
    return place / "assignment.yaml"


def grades(run: Run, words: Words | None = None) -> dict[str, str]:
    """Return the grades of the filled worksheet, by name."""
    name, grade = ("Full name", "Grade") if words is None else (words.header[1], words.header[5])
    return run.column(FILLED, grade, name)


def written(path: Path, content: bytes) -> Path:
    path.write_bytes(content)
    return path


def nothing_written(run: Run) -> bool:
    """Whether no grade was written: what was read is kept, and shown as `join.csv`."""
    there = {path.name for path in run.out.glob("*")} - {"unpacked", "join.csv"}
    return not {name for name in there if not name.startswith("ledger.")}


# groups


def in_groups() -> list[Person]:
    names = ["Team_1"] * 3 + ["Übung & Co"] * 2 + ["Default group"] * 2
    return [replace(one, group=name) for one, name in zip(people(7), names, strict=True)]


def test_every_output_has_the_groups_verdict_for_each_member(tmp_path: Path, zero: Path) -> None:
    class_ = in_groups()
    sheet = written(tmp_path / "worksheet.csv", worksheet(class_, bom=True))
    submissions = [("Team_1", 1003, 90), ("Übung & Co", 1000, 70), ("Default group", None, 50)]
    path = moodle_zip(tmp_path / "c.zip", [(name, n, scored(s)) for name, n, s in submissions])
    run = grade_all(path, tmp_path / "out", "--worksheet", sheet, "--assignment", zero)
    assert run.status == 1, run.output
    assert run.marked == 3, "one marking for each group"
    score = {name: f"{s}" for name, _, s in submissions}
    expected = {person.name: score[person.group] for person in class_}
    assert run.finals() == expected
    assert grades(run) == expected
    numbers = {person.id_number: score[person.group] for person in class_}
    title = "Your first ROS 2 node: Hello time"
    assert run.column(IMPORT, title, "ID number") == numbers
    for person in class_:
        text = (run.out / "feedback" / f"{person.feedback}.md").read_text(encoding="utf-8")
        assert person.name in text
        assert f"{score[person.group]} of 100 points" in text
    assert "Identical except for white space" not in run.output, "a group is no copy of itself"
    # a member who joins later is given the group's verdict, without another marking
    late = replace(class_[0], number=1020, name="Zoë Roe", id_number="1", email="zoe@x.y")
    sheet.write_bytes(worksheet([*class_, late]))
    again = grade_all(path, run.out, "--worksheet", sheet, "--assignment", zero)
    assert again.marked == 0
    assert again.finals() == {**expected, "Zoë Roe": "90"}
    regraded = grade_all(
        path, run.out, *("--worksheet", sheet, "--assignment", zero), "--regrade-student", "Zoë Roe"
    )
    assert regraded.marked == 1
    assert "Marked again: 4, 4 of them with the same result." in regraded.output


# a part of the class, or of the roster


@pytest.fixture(scope="session")
def course() -> list[Person]:
    """85 participants with a submission each; 53 are in the section that is marked."""
    class_ = people(85)
    return [*class_[:53], *marked(class_[53:], "77.50")]


@pytest.mark.parametrize("policy", ["none", "zero"])
@pytest.mark.full
def test_marking_one_section_lowers_no_grade_in_the_whole_worksheet(
    tmp_path: Path, zero: Path, course: list[Person], policy: str
) -> None:
    sheet = written(tmp_path / "worksheet.csv", worksheet(course))
    path = moodle_zip(tmp_path / "section.zip", of_people(course[:53]))
    words: list[str | Path] = ["--worksheet", sheet, "--roster", sheet]
    words += ["--assignment", zero] if policy == "zero" else []
    run = grade_all(path, tmp_path / "out", *words)
    assert run.status == 1, run.output
    assert grades(run) == {p.name: "90" if n < 53 else "77.50" for n, p in enumerate(course)}
    assert len(run.rows(IMPORT)) == 53
    statuses = run.column("gradebook.csv", "status", "name")
    assert {statuses[p.name] for p in course[53:]} == {"elsewhere"}
    assert {run.finals()[p.name] for p in course[53:]} == {""}
    text = {path.stem for path in (run.out / "feedback").glob("*.md")}
    assert text == {p.feedback for p in course[:53]}
    # the other section goes into the same folder: nothing of the first one is lost
    rest = moodle_zip(tmp_path / "rest.zip", of_people(course[53:], 95))
    both = grade_all(rest, run.out, *words)
    assert both.status == 1, both.output
    assert grades(both) == {p.name: "90" if n < 53 else "95" for n, p in enumerate(course)}
    assert both.finals() == grades(both)


def test_zeros_for_many_students_need_the_instructors_consent(tmp_path: Path, zero: Path) -> None:
    """Without submission statuses, a section looks like a class with many missing submissions."""
    class_ = people(10)
    lines = [f"{p.name},{p.id_number},{p.email}" for p in class_]
    roster = tmp_path / "roster.csv"
    roster.write_text("\n".join(["name,id number,email", *lines]) + "\n", encoding="utf-8")
    path = moodle_zip(tmp_path / "c.zip", of_people(class_[:7]))
    words: list[str | Path] = ["--roster", roster]
    refused = grade_all(path, tmp_path / "out", *words, "--assignment", zero)
    assert refused.status == 2
    assert "3 of 10 students" in refused.output
    assert "--accept join" in refused.output
    assert refused.marked == 0
    assert nothing_written(refused)
    went_on = grade_all(path, tmp_path / "out", *words, "--assignment", zero, "--accept", "join")
    zeros = {p.name: "90" if n < 7 else "0" for n, p in enumerate(class_)}
    assert went_on.finals() == zeros
    # without that policy nobody gets a zero
    plain = grade_all(path, tmp_path / "plain", *words)
    assert plain.status == 1
    assert plain.finals() == {p.name: "90" if n < 7 else "" for n, p in enumerate(class_)}


# words and encodings


@pytest.mark.parametrize("encoding", ["utf-8-sig", "cp949"])
def test_a_korean_class_is_matched_with_its_roster(
    tmp_path: Path, zero: Path, encoding: str
) -> None:
    class_ = people(47, korean=True)
    class_ = [replace(one, submitted=n >= 3) for n, one in enumerate(class_)]
    sheet = written(tmp_path / "worksheet.csv", worksheet(class_, KOREAN, encoding=encoding))
    path = moodle_zip(tmp_path / "c.zip", of_people(class_))
    words = ("--roster", sheet, "--worksheet", sheet, "--assignment", zero)
    run = grade_all(path, tmp_path / "out", *words)
    assert run.status == 1, run.output
    expected = {p.name: "90" if p.submitted else "0" for p in class_}
    assert run.finals() == expected
    assert grades(run, KOREAN) == expected
    assert ("CP949" in run.output) == (encoding == "cp949")
    assert (run.out / FILLED).read_bytes().startswith(b"\xef\xbb\xbf")


@pytest.mark.parametrize(
    ("roster", "output"),
    [
        ("Sarake;Toinen\n5;x\n6;x\n", "no column identifies a student"),
        # understood, and nobody of this class is on it
        ("이름,학번,이메일\n홍길동,1,hong@x.kr\n", "only 0 of 4 submissions are on the roster"),
    ],
)
def test_a_roster_that_matches_nobody_stops_before_anything_is_marked(
    tmp_path: Path, zero: Path, roster: str, output: str
) -> None:
    path = moodle_zip(tmp_path / "c.zip", of_people(people(4)))
    given = written(tmp_path / "roster.csv", roster.encode())
    run = grade_all(path, tmp_path / "out", "--roster", given, "--assignment", zero)
    assert run.status == 2
    assert output in run.output
    assert run.marked == 0
    assert nothing_written(run)


def test_a_worksheet_of_another_class_stops_the_run_unless_accepted(tmp_path: Path) -> None:
    class_ = people(5)
    other = [replace(p, number=p.number + 500) for p in people(40)[30:]]
    sheet = written(tmp_path / "worksheet.csv", worksheet([*other, class_[0]]))
    path = moodle_zip(tmp_path / "c.zip", of_people(class_))
    run = grade_all(path, tmp_path / "out", "--worksheet", sheet)
    assert (run.status, run.marked) == (2, 0)
    assert "only 1 of 5 submissions" in run.output
    accepted = grade_all(path, tmp_path / "out", "--worksheet", sheet, "--accept", "join")
    assert accepted.status == 1, accepted.output
    assert {name for name, grade in grades(accepted).items() if grade} == {class_[0].name}


# lower grades


def test_a_lower_grade_needs_the_instructors_consent(tmp_path: Path) -> None:
    class_ = marked(people(4), "95.00")
    sheet = written(tmp_path / "worksheet.csv", worksheet(class_))
    path = moodle_zip(tmp_path / "c.zip", of_people(class_, 90))
    run = grade_all(path, tmp_path / "out", "--worksheet", sheet)
    assert (run.status, run.marked) == (2, 4)
    assert "4 students would get a lower grade" in run.output
    assert f"{class_[0].name}: 95.00 in the Moodle worksheet, 90 now" in run.output
    assert nothing_written(run)
    # what is already known is reported before anything more is marked
    more = moodle_zip(tmp_path / "more.zip", of_people([*class_[:3], *people(5)[4:]], 90))
    sheet.write_bytes(worksheet([*class_, *people(5)[4:]]))
    early = grade_all(more, tmp_path / "out", "--worksheet", sheet)
    assert (early.status, early.marked) == (2, 1)
    assert "marking 1" not in early.output
    assert nothing_written(early)
    accepted = grade_all(path, tmp_path / "out", "--worksheet", sheet, "--accept", "join,lower")
    assert (accepted.status, accepted.marked) == (1, 0), "the verdicts were kept"
    assert {grades(accepted)[person.name] for person in class_} == {"90"}


def test_earlier_submissions_stay_in_the_gradebook(tmp_path: Path, zero: Path) -> None:
    class_ = people(6)
    lines = [f"{p.name},{p.id_number}" for p in class_]
    roster = tmp_path / "roster.csv"
    roster.write_text("\n".join(["name,id number", *lines]) + "\n", encoding="utf-8")
    words = ("--roster", roster, "--assignment", zero)
    whole = moodle_zip(tmp_path / "whole.zip", of_people(class_))
    first = grade_all(whole, tmp_path / "out", *words)
    assert set(first.finals().values()) == {"90"}
    # two students are missing in the next download: the ledger has their verdicts
    part = moodle_zip(tmp_path / "part.zip", of_people(class_[:4], 95))
    again = grade_all(part, tmp_path / "out", *words, "--accept", "join")
    expected = {p.name: "95" if n < 4 else "90" for n, p in enumerate(class_)}
    assert again.finals() == expected
    assert set(again.column("gradebook.csv", "status", "name").values()) == {"graded"}
    # if the ledger is lost, the gradebook has their grades
    (tmp_path / "out" / "ledger.sqlite").unlink()
    again = grade_all(part, tmp_path / "out", *words)
    assert again.status == 1, again.output
    assert again.finals() == expected
    assert again.column("gradebook.csv", "status", "name")[class_[5].name] == "elsewhere"
    # without the roster nothing shows that they belong to this class: their rows would be removed
    gone = grade_all(part, tmp_path / "out", "--assignment", zero)
    assert gone.status == 2
    assert "2 students would get a lower grade" in gone.output
    assert again.finals() == expected


# Canvas


def canvas(tmp_path: Path, class_: Sequence[Person], score: float = 90) -> Path:
    return canvas_zip(tmp_path / "submissions.zip", class_, score)


def test_the_canvas_gradebook_is_checked_before_anything_is_marked(tmp_path: Path) -> None:
    class_ = people(3)
    path = canvas(tmp_path, class_)
    columns = ["Hello world (76)", "Hello time again (77)"]
    gradebook = written(tmp_path / "g.csv", canvas_gradebook(class_, columns=columns))
    run = grade_all(path, tmp_path / "out", "--canvas", gradebook)
    assert (run.status, run.marked) == (2, 0)
    assert "'Hello time again (77)'" in run.output
    assert "CANVAS_COLUMN=" in run.output
    assert nothing_written(run)
    named = grade_all(path, tmp_path / "out", "--canvas", gradebook, "--canvas-column", "77")
    assert named.status == 1, named.output
    filled = named.rows("canvas-gradebook.csv")
    assert [row[columns[1]] for row in filled] == ["100.00", "90", "90", "90"]


def test_a_missing_submission_does_not_lower_a_canvas_grade(tmp_path: Path, zero: Path) -> None:
    class_ = people(6)
    column = "Your first ROS 2 node: Hello time (77)"
    held = [*class_[:5], replace(class_[5], grade="70")]
    gradebook = written(tmp_path / "g.csv", canvas_gradebook(held))
    path = canvas(tmp_path, class_[:5])
    words = ("--canvas", gradebook, "--roster", gradebook, "--assignment", zero)
    run = grade_all(path, tmp_path / "out", *words)
    assert run.status == 1, run.output
    filled = run.rows("canvas-gradebook.csv")[1:]
    assert [row[column] for row in filled] == ["90"] * 5 + ["70"]


def test_a_failed_output_does_not_prevent_the_others(tmp_path: Path) -> None:
    """A correction beyond the worksheet's maximum is detected only after marking."""
    class_ = people(3)
    sheet = written(tmp_path / "worksheet.csv", worksheet(class_))
    gradebook = written(tmp_path / "g.csv", canvas_gradebook(class_))
    path = moodle_zip(tmp_path / "c.zip", of_people(class_))
    words = ("--worksheet", sheet, "--canvas", gradebook)
    first = grade_all(path, tmp_path / "out", *words)
    assert first.status == 1, first.output
    before = (first.out / FILLED).read_bytes()
    correct(first.out, class_[0], 120)
    again = grade_all(path, first.out, *words)
    assert again.status == 2
    assert "more points than the Moodle worksheet allows" in again.output
    assert "All other files were written" in again.output
    assert again.finals()[class_[0].name] == "120"
    column = "Your first ROS 2 node: Hello time (77)"
    assert [row[column] for row in again.rows("canvas-gradebook.csv")][1:] == ["120", "90", "90"]
    assert "120" in (again.out / "index.html").read_text(encoding="utf-8")
    assert (again.out / FILLED).read_bytes() == before
    # withdrawing it lowers a grade, to which the instructor has consented by doing so
    correct(first.out, class_[0], None)
    last = grade_all(path, first.out, *words)
    assert last.status == 1, last.output
    assert set(last.finals().values()) == {"90"}


def correct(out: Path, person: Person, points: float | None) -> None:
    """Correct a student's total or withdraw the correction with `grader override`."""
    from grader.cli.main import main

    words = ["override", person.name, "--out", str(out)]
    given = ["--points", str(points), "--because", "x", "--force"]
    assert main([*words, *(["--remove"] if points is None else given)]) == 0
