"""What goes back to the students: files that a person finds, and the zips that systems take back."""

from __future__ import annotations

import csv
import dataclasses
import io
import tarfile
import zipfile
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grader.batch.model import ClassResult, Student
from grader.batch.systems.feedback_zip import in_place_of
from grader.batch.systems.known import SYSTEMS
from grader.publish.feedback_names import feedback_names
from grader.publish.gradebooks import write_outputs
from grader.publish.pages.names import page_names
from tests.gradebook.hostile_texts import texts


def participant(path: str) -> tuple[int, str] | None:
    """Read a member's name as Moodle's importziplib.php does: the participant and the file."""
    parts = path.split("/")
    while parts:
        info = parts.pop(0).split("_", 4)
        if len(info) >= 4 and info[1].isdecimal() and info[2:4] == ["assignsubmission", "file"]:
            return int(info[1]), "/".join([*info[4:5], *parts]).lstrip("/")
    return None


def canvas_ids(name: str) -> list[str]:
    """Read a member's name as Canvas' infer_comment_context_from_filename does."""
    return [part for part in Path(name).name.split("_") if part.isdecimal()][:2]


def members(path: Path) -> dict[str, bytes]:
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None
        return {name: archive.read(name) for name in archive.namelist()}


def test_moodle_finds_each_student_in_the_feedback_zip(mixed: ClassResult, tmp_path: Path) -> None:
    hostile = dataclasses.replace(mixed.entries[0].student, name="Mc_Evil 7_8/../\u202e")
    entries = (dataclasses.replace(mixed.entries[0], student=hostile), *mixed.entries[1:])
    result = dataclasses.replace(mixed, entries=entries, system=SYSTEMS["moodle"])
    write_outputs(result, tmp_path)
    found = {
        participant(name): page for name, page in members(tmp_path / "moodle-feedback.zip").items()
    }
    wanted = {
        (int(e.student.key), "feedback.html")
        for e in entries
        if e.final is not None and not e.keeps_grade
    }
    assert set(found) == wanted
    assert all(b"points" in page for page in found.values())


def test_canvas_gets_the_names_as_downloaded_and_files_that_open(
    mixed: ClassResult, tmp_path: Path
) -> None:
    names = ["lee_1002_5551_robot-1.zip", "poe_LATE_77_88_robot.tar.gz", "ray_9_10_node_1.py"]
    graded = [e for e in mixed.entries if e.final is not None and e.status == "graded"][:4]
    entries = [dataclasses.replace(e, files=(name,)) for e, name in zip(graded, names)]
    result = dataclasses.replace(mixed, entries=(*entries, graded[3]), system=SYSTEMS["canvas"])
    messages: list[str] = []
    write_outputs(result, tmp_path, notify=messages.append)
    found = members(tmp_path / "canvas-feedback.zip")
    assert list(found) == names
    assert [canvas_ids(name) for name in found] == [["1002", "5551"], ["77", "88"], ["9", "10"]]
    (inner,) = zipfile.ZipFile(io.BytesIO(found[names[0]])).namelist()
    assert inner == "feedback.html"
    with tarfile.open(fileobj=io.BytesIO(found[names[1]])) as archive:
        assert archive.getnames() == ["feedback.html"]
    assert found[names[2]].startswith(b"# ")
    assert any(graded[3].student.name in message for message in messages), "not silently left out"


@pytest.mark.parametrize("name", ["a.ZIP", "a.tgz", "a.tar.xz", "a.html", "a.pdf"])
def test_a_file_in_the_place_of_another_has_its_form(name: str) -> None:
    content = in_place_of(name, b"<!doctype html>", "text")
    starts = {
        ".ZIP": b"PK",
        ".tgz": b"\x1f\x8b",
        ".xz": b"\xfd7zXZ",
        ".html": b"<!doc",
        ".pdf": b"text",
    }
    assert content.startswith(starts[Path(name).suffix])


def test_a_person_finds_a_student_in_any_script() -> None:
    class_ = [
        Student("김민지", "김민지", id_number="2026001"),
        Student("1002", "محمد علي"),
        Student("1003", "Ann  O'Hara-Lee"),
        Student("1004", "José Núñez"),
        Student("../con", ""),
        Student("CON", "CON"),
    ]
    names = list(feedback_names(class_).values())
    assert names[:5] == [
        "김민지_2026001",
        "محمد_علي_1002",
        "Ann_O_Hara_Lee_1003",
        "José_Núñez_1004",
        "con-" + names[4][4:],
    ]
    assert names[5].startswith("CON-")


@given(st.lists(st.tuples(texts, texts), min_size=1, max_size=8, unique_by=lambda pair: pair[0]))
def test_names_are_safe_and_never_shared(pairs: list[tuple[str, str]]) -> None:
    class_ = [Student(key, name) for key, name in pairs]
    names = feedback_names(class_)
    assert len({name.casefold() for name in names.values()}) == len(class_)
    for name in names.values():
        assert name.isprintable()
        assert not set(name) & set('/\\:*?"<>| .')
        assert 0 < len(name.encode()) <= 255 - len(".html")
    assert names == feedback_names(reversed(class_))


def test_feedback_under_an_earlier_name_is_removed(mixed: ClassResult, tmp_path: Path) -> None:
    key = mixed.entries[0].student.key
    earlier = tmp_path / "feedback" / page_names([key])[key]
    earlier.parent.mkdir(mode=0o700)
    earlier.write_text("of an earlier grader")
    own = earlier.with_name("notes.md")
    own.write_text("mine")
    write_outputs(mixed, tmp_path)
    student = dataclasses.replace(mixed.entries[0].student, name="New Name")
    first = dataclasses.replace(mixed.entries[0], student=student)
    write_outputs(dataclasses.replace(mixed, entries=(first, *mixed.entries[1:])), tmp_path)
    assert not earlier.exists()
    assert own.exists()
    listed = list(csv.DictReader(io.StringIO((tmp_path / "feedback.csv").read_text("utf-8-sig"))))
    assert listed[0]["page"].startswith("feedback/New_Name_")
    there = {f"feedback/{path.name}" for path in (tmp_path / "feedback").iterdir()}
    assert there == {row[column] for row in listed for column in ("page", "text")} | {
        "feedback/notes.md"
    }
