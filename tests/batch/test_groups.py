"""Group submissions: their members, and that nobody gets another group's verdict."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from grader.batch.discover import discover
from grader.batch.model import ClassFolder
from tests.batch.archives import package, write
from tests.batch.downloads import (
    ENGLISH,
    FINNISH,
    KOREAN,
    Person,
    Words,
    moodle_zip,
    people,
    scored,
    worksheet,
)


def grouped(*sizes: tuple[str, int]) -> list[Person]:
    """Return participants, with the given number in each group."""
    names = [name for name, size in sizes for _ in range(size)]
    return [replace(one, group=name) for one, name in zip(people(len(names)), names, strict=True)]


def found_for(
    tmp_path: Path,
    class_: Sequence[Person],
    *folders: tuple[str, int | None],
    words: Words = ENGLISH,
) -> ClassFolder:
    """Discover a download with these folders, with the worksheet as the roster."""
    (tmp_path / "roster.csv").write_bytes(worksheet(class_, words))
    path = moodle_zip(tmp_path / "class.zip", [(name, n, scored(90)) for name, n in folders])
    return discover(path, roster=tmp_path / "roster.csv", unpack=tmp_path / "work")


def members(found: ClassFolder) -> dict[str, list[str]]:
    """Return the folders of each student's submissions."""
    whose: dict[str, list[str]] = {}
    for given in found.handed_in:
        place = given.path.parent.name if given.path.is_file() else given.path.name
        whose.setdefault(given.student.name, []).append(place.partition("_assignsubmission")[0])
    return whose


@pytest.mark.parametrize(
    ("name", "folder"),
    [
        ("Blue", "Blue_7"),
        ("Team_1 a", "Team 1 a_7"),
        ("Größe & Übung", "Größe amp; Übung_7"),
        ('A/B: "x"', "AB x_7"),
        ("팀 하나", "팀 하나_7"),
        ("Kim, Lee", "Kim, Lee_7"),
        (" Blue ", " Blue _7"),
    ],
)
def test_every_member_has_the_groups_submission(tmp_path: Path, name: str, folder: str) -> None:
    class_ = grouped((name, 3), ("Other", 2))
    found = found_for(tmp_path, class_, (name, 7), ("Other", 8))
    expected = {p.name: [folder if p.group == name else "Other_8"] for p in class_}
    assert members(found) == expected
    assert [given.student.key for given in found.handed_in] == [str(p.number) for p in class_]
    assert {given.attempt for given in found.handed_in} == {1}
    assert not found.missing
    assert found.on_roster is not None
    assert (found.on_roster.submissions, found.on_roster.strangers) == (2, ())


def test_a_student_without_a_group_has_the_default_groups_submission(tmp_path: Path) -> None:
    class_ = grouped(("Blue", 2), (KOREAN.default_group, 3))
    found = found_for(tmp_path, class_, ("Blue", 7), (KOREAN.default_group, None), words=KOREAN)
    assert [place for (place,) in members(found).values()] == ["Blue_7"] * 2 + ["기본 모둠"] * 3


def test_a_group_without_a_submission_is_missing(tmp_path: Path) -> None:
    class_ = [replace(p, submitted=p.group == "Blue") for p in grouped(("Blue", 2), ("Red", 2))]
    found = found_for(tmp_path, class_, ("Blue", 7))
    assert [student.name for student in found.missing] == [p.name for p in class_[2:]]
    assert not found.elsewhere


def test_a_group_number_is_not_a_participant_number(tmp_path: Path) -> None:
    """Group 1003 is not participant 1003, who belongs to another group."""
    class_ = grouped(("Blue", 2), ("Red", 3))
    found = found_for(tmp_path, class_, ("Blue", class_[3].number), ("Red", class_[0].number))
    assert [place for (place,) in members(found).values()] == ["Blue_1003"] * 2 + ["Red_1000"] * 3
    # the same if the roster does not have the group
    (tmp_path / "other").mkdir()
    unknown = found_for(tmp_path / "other", class_, ("Green", class_[3].number), ("Red", 5))
    assert members(unknown)["Green"] == ["Green_1003"]
    assert [student.name for student in unknown.missing] == [p.name for p in class_[:2]]


def test_a_number_without_the_matching_name_identifies_nobody(tmp_path: Path) -> None:
    """A roster without a group column: any group number may also be a participant's."""
    class_ = people(6)
    found = found_for(tmp_path, class_, ("Blue", 1003), ("Red", 1000), ("Green", 8))
    assert members(found).keys() == {"Blue", "Red", "Green"}
    assert len(found.missing) == 6
    # a student whose name has changed is still identified by the number
    (tmp_path / "married").mkdir()
    folders = [(p.name, p.number) for p in class_[:3]]
    one = found_for(tmp_path / "married", class_, ("Bo Fox", 1003), *folders)
    assert [student.name for student in one.missing] == [p.name for p in class_[4:]]


def test_a_group_named_like_the_participant_with_its_number_is_a_group(tmp_path: Path) -> None:
    class_ = grouped(("Red", 2), ("Team Lee", 2))
    assert class_[0].name == "Ann Lee"
    found = found_for(tmp_path, class_, ("Team Lee", class_[0].number), ("Red", 7))
    assert [place for (place,) in members(found).values()] == ["Red_7"] * 2 + ["Team Lee_1000"] * 2


def test_a_member_with_an_individual_submission_has_two_attempts(tmp_path: Path) -> None:
    class_ = grouped(("Blue", 2))
    found = found_for(tmp_path, class_, ("Blue", 7), (class_[1].name, class_[1].number))
    alone = f"{class_[1].name}_{class_[1].number}"
    assert members(found) == {class_[0].name: ["Blue_7"], class_[1].name: ["Blue_7", alone]}
    second = [given for given in found.handed_in if given.student.name == class_[1].name]
    assert [given.attempt for given in second] == [1, 2]
    assert any("also handed in alone" in note for note in second[0].notes)


def test_group_names_that_differ_only_in_case_are_distinguished(tmp_path: Path) -> None:
    class_ = grouped(("Blue", 2), ("blue", 2))
    found = found_for(tmp_path, class_, ("blue", 7), ("Blue", 8))
    assert [place for (place,) in members(found).values()] == ["Blue_8"] * 2 + ["blue_7"] * 2


def test_ambiguous_groups_get_no_verdict(tmp_path: Path) -> None:
    """Moodle gives the folders of `Team_1` and `Team 1` the same name."""
    class_ = grouped(("Team_1", 2), ("Team 1", 2), ("Red", 3))
    found = found_for(tmp_path, class_, ("Team_1", 7), ("Team 1", 8), ("Red", 9))
    own = {p.name for p in class_[4:]}
    assert {name for name, places in members(found).items() if places == ["Red_9"]} == own
    assert [student.name for student in found.missing] == [p.name for p in class_[:4]]
    assert found.elsewhere.keys() == {student.key for student in found.missing}
    assert all("Team" in where.reason for where in found.elsewhere.values())
    assert all(where.is_unclear for where in found.elsewhere.values())
    assert len(found.unclear) == 2
    assert all(one.unclear for one in found.handed_in if one.student.name == "Team 1")
    assert found.on_roster is not None
    assert not found.on_roster.strangers, "they are on the roster, it is only not clear where"


def test_the_group_column_is_found_in_an_unknown_language(tmp_path: Path) -> None:
    class_ = grouped(("Sininen", 3), ("Punainen", 2))
    found = found_for(tmp_path, class_, ("Sininen", 7), ("Punainen", 8), words=FINNISH)
    assert [place for (place,) in members(found).values()] == ["Sininen_7"] * 3 + ["Punainen_8"] * 2
    assert any("'Ryhmittely' was used as the group" in note for note in found.notes)


def test_a_folder_named_after_a_group_belongs_to_its_members(tmp_path: Path) -> None:
    for name in ("Blue", "Red", "Zoë Roe"):
        write(tmp_path / "class" / name, package())
    roster = tmp_path / "roster.csv"
    lines = ["Ann Lee,ann@x.y,Blue; Lab 1", "Ben Ray,ben@x.y,Blue; Lab 2", "Cy Poe,cy@x.y,Red"]
    lines += ["Zoë Roe,zoe@x.y,", "Di Fox,di@x.y,Blue; Red"]
    roster.write_text("name,email,group\n" + "\n".join(lines) + "\n", encoding="utf-8")
    found = discover(tmp_path / "class", roster=roster, unpack=tmp_path / "work")
    assert members(found) == {
        "Ann Lee": ["Blue"],
        "Ben Ray": ["Blue"],
        "Cy Poe": ["Red"],
        "Zoë Roe": ["Zoë Roe"],
    }
    assert "more than one group" in found.elsewhere["di@x.y"].reason


def test_a_student_with_the_name_of_a_group_is_not_the_group(tmp_path: Path) -> None:
    """The other members of that group do not get that student's submission."""
    class_ = people(4)
    lines = [f"{p.name},{p.email},Lab A" for p in class_]
    roster = tmp_path / "roster.csv"
    roster.write_text("\n".join(["name,email,group", *lines]) + "\n", encoding="utf-8")
    folders = [(p.name, p.number, scored(50)) for p in class_[:2]]
    path = moodle_zip(tmp_path / "c.zip", [*folders, ("Lab A", 1003, scored(100))])
    found = discover(path, roster=roster, unpack=tmp_path / "work")
    assert members(found)["Lab A"] == ["Lab A_1003"]
    assert [student.name for student in found.missing] == [p.name for p in class_[2:]]


def test_without_a_roster_a_group_has_its_folder_name(tmp_path: Path) -> None:
    path = moodle_zip(tmp_path / "class.zip", [("Blue", 7, scored(90)), ("Red", 8, scored(90))])
    found = discover(path, unpack=tmp_path / "work")
    assert members(found) == {"Blue": ["Blue_7"], "Red": ["Red_8"]}
