"""Downloads of Moodle, Canvas and Gradescope, as folders and as zips."""

from __future__ import annotations

import time
from collections.abc import Mapping
from datetime import datetime, timezone
from pathlib import Path

import pytest
import yaml

from grader.batch.discover import discover
from grader.batch.model import ClassFolder, HandedIn

from .archives import NODE_PATH, class_zip, everything_below, package, take, write, zipped

WAYS = ["folder", "zip"]


def downloaded(tmp_path: Path, files: Mapping[str, bytes], way: str) -> ClassFolder:
    """Discover a system's download: its zip, or the folder with its unpacked files."""
    if way == "zip":
        path = class_zip(tmp_path / "course-hw1-42.zip", files)
    else:
        path = write(tmp_path / "course-hw1-42", files)
    return discover(path, unpack=tmp_path / "work")


def below(start: str, files: Mapping[str, bytes]) -> dict[str, bytes]:
    return {f"{start}/{path}": data for path, data in files.items()}


def by_key(found: ClassFolder) -> dict[str, list[HandedIn]]:
    keys: dict[str, list[HandedIn]] = {}
    for given in found.handed_in:
        keys.setdefault(given.student.key, []).append(given)
    return keys


def notes_of(thing: ClassFolder | HandedIn) -> str:
    return "\n".join(thing.notes)


def is_marked(given: HandedIn) -> bool:
    return not given.problem and take(given.path, modes_kept=given.modes_kept).problem == ""


# Moodle

FILE = "assignsubmission_file"


@pytest.mark.parametrize("way", WAYS)
def test_moodles_folders_are_identified_by_participant_number(tmp_path: Path, way: str) -> None:
    found = downloaded(
        tmp_path,
        {
            **below(f"Zoë Roe_7_{FILE}", package()),
            **below(f"Ann 2 Lee_123_{FILE}_", {"pkg.zip": zipped(package())}),
            **below("Ann 2 Lee_123_assignsubmission_onlinetext", {"onlinetext.html": b"hello"}),
            **below("Max Ray_9_assignsubmission_onlinetext", {"onlinetext.html": b"done"}),
        },
        way,
    )
    assert found.system.name == "moodle"
    assert [(given.student.key, given.student.name) for given in found.handed_in] == [
        ("123", "Ann 2 Lee"),
        ("9", "Max Ray"),
        ("7", "Zoë Roe"),
    ]
    ann, max_, zoe = found.handed_in
    assert is_marked(ann)
    assert is_marked(zoe)
    assert not zoe.modes_kept
    assert "onlinetext" in notes_of(ann)
    assert "only text" in max_.problem
    assert [given.submitted for given in found.handed_in] == [None] * 3
    assert "does not contain the times" in notes_of(found)


@pytest.mark.parametrize("way", WAYS)
def test_moodles_files_without_folders_are_grouped_by_participant(tmp_path: Path, way: str) -> None:
    loose = {f"Joe Poe_5_{FILE}_{name}": b"x" for name in ("setup.py", "package.xml")}
    found = downloaded(
        tmp_path,
        {f"Ann Lee_123_{FILE}_my_pkg_1.zip": zipped(package()), **loose},
        way,
    )
    keys = by_key(found)
    (ann,), (joe,) = keys["123"], keys["5"]
    assert ann.path.name == f"Ann Lee_123_{FILE}_my_pkg_1.zip"
    assert is_marked(ann)
    assert everything_below(joe.path) == {"setup.py", "package.xml"}
    again = downloaded(tmp_path, {}, way) if way == "folder" else None
    assert again is None or by_key(again)["5"][0].path == joe.path


def test_a_file_name_cannot_impersonate_another_student(tmp_path: Path) -> None:
    name = f"Eve_7_{FILE}_x_123_{FILE}_pkg.zip"
    found = downloaded(tmp_path, {name: zipped(package())}, "folder")
    assert [(given.student.key, given.student.name) for given in found.handed_in] == [("7", "Eve")]


def test_anonymous_students_and_teams_of_moodle_are_distinguished(tmp_path: Path) -> None:
    found = downloaded(
        tmp_path,
        {
            **below(f"Participant_11_{FILE}", package()),
            **below(f"Participant_12_{FILE}", package()),
            **below(f"The A Team_3_{FILE}", package()),
            **below(f"Default group_{FILE}", package()),
        },
        "zip",
    )
    assert {key: given[0].student.name for key, given in by_key(found).items()} == {
        "11": "Participant 11",
        "12": "Participant 12",
        "3": "The A Team",
        "Default group": "Default group",
    }
    assert "number is not in the name" in notes_of(by_key(found)["Default group"][0])


def test_anonymous_students_in_another_language_are_distinguished(tmp_path: Path) -> None:
    files = {f"Teilnehmer in_{n}_{FILE}_pkg.zip": zipped(package()) for n in (4, 5)}
    found = by_key(downloaded(tmp_path, files, "folder"))
    assert [given[0].student.name for given in found.values()] == [
        "Teilnehmer in 4",
        "Teilnehmer in 5",
    ]


def test_equal_names_and_equal_numbers_stay_separate_students(tmp_path: Path) -> None:
    found = downloaded(
        tmp_path,
        {
            **below(f"Ann Lee_1_{FILE}", package()),
            **below(f"Ann Lee_2_{FILE}", package()),
            **below(f"Joe_3_{FILE}", package()),
            **below(f"Max_3_{FILE}", package()),
        },
        "folder",
    )
    assert sorted(by_key(found)) == ["1", "2", "3 Joe", "3 Max"]


@pytest.mark.parametrize("way", WAYS)
def test_a_folder_added_by_the_instructor_is_marked(tmp_path: Path, way: str) -> None:
    found = downloaded(
        tmp_path,
        {
            **below(f"Ann Lee_1_{FILE}", package()),
            **below(f"Joe Poe_2_{FILE}", package()),
            "by mail.zip": zipped(package()),
            "2.zip": zipped(package()),
        },
        way,
    )
    assert by_key(found)["2"][0].student.name == "Joe Poe"
    assert [given.path.name for given in by_key(found)["2 (by hand)"]] == ["2.zip"]
    (mail,) = by_key(found)["by mail"]
    assert is_marked(mail)
    assert "not named as in Moodle" in notes_of(mail)
    assert found.system.name == "moodle"


# Canvas


@pytest.mark.parametrize("way", WAYS)
def test_canvas_files_are_identified_by_user_number(tmp_path: Path, way: str) -> None:
    found = downloaded(
        tmp_path,
        {
            "doejane_101_9001_my_pkg.zip": zipped(package()),
            "roe_joe_LATE_102_9002_2026_final.zip": zipped(package()),
            "poemax_103_text.html": b"<p>I did it</p>",
            "kimzoe_LATE_104_link.html": b"<a>",
        },
        way,
    )
    assert found.system.name == "canvas"
    keys = by_key(found)
    (jane,), (joe,), (max_,), (zoe,) = keys["101"], keys["102"], keys["103"], keys["104"]
    assert [given.student.name for given in (jane, joe)] == ["doejane", "roe_joe"]
    assert [given.late for given in (jane, joe, max_, zoe)] == [False, True, False, True]
    assert is_marked(jane)
    assert is_marked(joe)
    assert "typed" in max_.problem
    assert "typed" in zoe.problem
    assert jane.submitted is None


def test_several_attachments_of_canvas_are_one_submission(tmp_path: Path) -> None:
    files = {
        f"doejane_101_{9000 + n}_{name.rpartition('/')[2]}": data
        for n, (name, data) in enumerate(package().items())
    }
    found = downloaded(
        tmp_path, {**files, "doejane_101_text.html": b"<p>", "x_1_2_a.zip": b"PK"}, "zip"
    )
    (jane,) = by_key(found)["101"]
    assert everything_below(jane.path) >= {"package.xml", "setup.py", "setup.cfg"}
    assert take(jane.path).root == "."
    assert not jane.modes_kept
    assert "doejane_101_text.html" in notes_of(jane)


def test_a_resubmission_on_canvas_is_a_later_attempt(tmp_path: Path) -> None:
    found = downloaded(
        tmp_path,
        {
            "doejane_101_9003_pkg-2.tar.gz": b"third",
            "doejane_101_9001_pkg.tar.gz": b"first",
            "doejane_101_10000_pkg-1.tar.gz": b"last of all",
        },
        "folder",
    )
    assert [(given.attempt, given.path.read_bytes()) for given in found.handed_in] == [
        (1, b"first"),
        (2, b"third"),
        (3, b"last of all"),
    ]
    assert "again" in notes_of(found.handed_in[0])


def test_a_file_that_canvas_numbered_gets_its_original_name(tmp_path: Path) -> None:
    files = {"doejane_101_9001_setup-1.py": b"a", "doejane_101_9002_package-3.xml": b"b"}
    (jane,) = downloaded(tmp_path, files, "folder").handed_in
    assert everything_below(jane.path) == {"setup.py", "package.xml"}
    assert "setup-1.py" in notes_of(jane)


def test_anonymous_students_of_canvas_are_distinguished(tmp_path: Path) -> None:
    found = downloaded(
        tmp_path,
        {
            "anon_8Qz1T_9001_pkg.zip": zipped(package()),
            "LATE_anon_aB3x9_9002_pkg.zip": zipped(package()),
        },
        "zip",
    )
    late = {key: given[0].late for key, given in by_key(found).items()}
    assert late == {"anon_8Qz1T": False, "anon_aB3x9": True}


def test_an_ambiguous_file_name_of_canvas_is_reported(tmp_path: Path) -> None:
    files = {"doe_999_101_9001_pkg.zip": zipped(package()), "roe_102_9002_pkg.zip": b"PK"}
    found = by_key(downloaded(tmp_path, files, "folder"))
    assert "not certain" in notes_of(found["999"][0])
    assert "not certain" not in notes_of(found["102"][0])


# Gradescope

METADATA = """\
submission_71:
  :submitters:
  - :name: Zoë Roe
    :sid: '0123'
    :email: zoe@school.edu
  :created_at: 2026-03-04 18:20:30.158417000 Z
  :score: 12.0
  :status: processed
  :results: {}
  :history:
  - :id: 70
    :created_at: 2026-03-03 18:20:30.158417000 Z
    :score: 1.0
submission_72:
  :submitters:
  - :name: Ann Lee
    :sid: 4711
    :email: ann@school.edu
  - :name: Joe Poe
    :sid:
    :email: joe@school.edu
  :created_at: !ruby/object:ActiveSupport::TimeWithZone
    utc: 2026-03-04 09:00:00.000000000 Z
    zone: !ruby/object:ActiveSupport::TimeZone
      name: America/New_York
    time: 2026-03-04 04:00:00.000000000 Z
submission_73:
  :submitters: []
  :created_at: soon
submission_74:
  :submitters:
  - :name: Gone Girl
    :sid: '9'
    :email: gone@school.edu
"""


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("top", ["", "assignment_5_export/"])
def test_gradescopes_export_has_names_and_times(tmp_path: Path, way: str, top: str) -> None:
    files = {f"{top}submission_metadata.yml": METADATA.encode()}
    for number in (71, 72, 73, 75):
        files |= below(f"{top}submission_{number}", package())
    found = downloaded(tmp_path, files, way)
    assert found.system.name == "gradescope"
    keys = by_key(found)
    assert sorted(keys) == ["0123", "4711", "9", "joe@school.edu", "submission_73", "submission_75"]
    (zoe,), (ann,), (joe,) = keys["0123"], keys["4711"], keys["joe@school.edu"]
    assert (zoe.student.name, zoe.student.email) == ("Zoë Roe", "zoe@school.edu")
    assert zoe.student.id_number == "0123"
    assert zoe.submitted == datetime(2026, 3, 4, 18, 20, 30, 158417, timezone.utc)
    assert "the last of 2 attempts" in notes_of(zoe)
    assert ann.path == joe.path
    assert "Ann Lee, Joe Poe" in notes_of(joe)
    assert ann.submitted == joe.submitted == datetime(2026, 3, 4, 9, 0, tzinfo=timezone.utc)
    assert keys["submission_73"][0].submitted is None
    assert "not in submission_metadata.yml" in notes_of(keys["submission_75"][0])
    assert "folder is not in the export" in keys["9"][0].problem
    assert all(is_marked(given) for given in (zoe, ann, joe, keys["submission_75"][0]))


@pytest.mark.parametrize(
    "metadata",
    [
        b"a: [",
        b"- 1\n- 2\n",
        b"!!python/object/apply:os.system ['touch pwned']",
        b"\xff\xfe\x00",
        b"submission_71: 5\n../../etc:\n  :submitters: []\n1: {}\n",
        b"[" * 5_000,
        b"",
    ],
)
def test_damaged_metadata_of_gradescope_loses_only_the_names(
    tmp_path: Path, metadata: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    files = {"submission_metadata.yml": metadata, **below("submission_71", package())}
    found = downloaded(tmp_path, {**files, **below("submission_72", package())}, "folder")
    assert sorted(by_key(found)) == ["submission_71", "submission_72"]
    assert not (tmp_path / "pwned").exists()
    assert all(is_marked(given) for given in found.handed_in)


def test_two_submissions_of_a_student_are_attempts_ordered_by_time(tmp_path: Path) -> None:
    metadata = "".join(
        f"submission_{n}:\n  :submitters:\n  - :name: Ann\n    :sid: '5'\n"
        f"  :created_at: 2026-03-0{day} 18:20:30 Z\n"
        for n, day in ((1, 4), (2, 3), (3, 5))
    )
    files = {"submission_metadata.yml": metadata.encode()}
    for n in (1, 2, 3):
        files |= below(f"submission_{n}", package())
    found = downloaded(tmp_path, files, "folder")
    assert [(given.attempt, given.path.name) for given in found.handed_in] == [
        (1, "submission_2"),
        (2, "submission_1"),
        (3, "submission_3"),
    ]


@pytest.mark.long
def test_large_results_in_gradescope_metadata_are_skipped_quickly(
    tmp_path: Path,
) -> None:
    text = "\n  :submitters:\n  - :name: Evil\n    :sid: 666\nsubmission_2:\n" * 20
    results = {":tests": [{":output": text, ":score": 1.0}] * 10, ":output": text}
    metadata = {
        f"submission_{n}": {
            ":submitters": [{":name": f"Student {n}", ":sid": f"{n}", ":email": f"{n}@x.y"}],
            ":results": results,
            ":created_at": datetime(2026, 3, 4, 18, 20, n, tzinfo=timezone.utc),
            ":history": [{":id": 901, ":results": results}, {":id": 902, ":results": results}],
        }
        for n in range(1, 41)
    }
    dumper = type("Dumper", (yaml.SafeDumper,), {"ignore_aliases": lambda self, data: True})
    content = yaml.dump(metadata, Dumper=dumper, sort_keys=False).encode()
    assert len(content) > 2_000_000
    fifth = dict(list(metadata.items())[: len(metadata) // 5])
    begin = time.process_time()
    yaml.safe_load(yaml.dump(fifth, Dumper=dumper, sort_keys=False))
    a_fifth_as_yaml = time.process_time() - begin
    files = {f"submission_{n}/setup.py": b"" for n in range(1, 41)}
    begin = time.process_time()
    found = downloaded(tmp_path, {"submission_metadata.yml": content, **files}, "folder")
    assert time.process_time() - begin < a_fifth_as_yaml
    assert sorted(int(key) for key in by_key(found)) == list(range(1, 41))
    for key, (work,) in by_key(found).items():
        assert work.submitted is not None
        assert (work.student.name, work.submitted.second) == (f"Student {key}", int(key))
        assert "the last of 3 attempts" in notes_of(work)
    by_aliases = yaml.dump(metadata, sort_keys=False).encode()
    assert b"*id" in by_aliases
    (tmp_path / "course-hw1-42" / "submission_metadata.yml").write_bytes(by_aliases)
    again = discover(tmp_path / "course-hw1-42", unpack=tmp_path / "work")
    assert again.handed_in == found.handed_in


def test_gradescope_students_with_the_same_number_stay_separate(tmp_path: Path) -> None:
    metadata = "".join(
        f"submission_{n}:\n  :submitters:\n  - {{':name': {name}, ':sid': 5, ':email': {name}@x}}\n"
        for n, name in ((1, "Ann"), (2, "Joe"), (3, "Joe"))
    )
    files = {"submission_metadata.yml": metadata.encode()}
    for n in (1, 2, 3):
        files |= below(f"submission_{n}", package())
    found = by_key(downloaded(tmp_path, files, "folder"))
    assert {key: [given.attempt for given in group] for key, group in found.items()} == {
        "5 Ann@x": [1],
        "5 Joe@x": [1, 2],
    }


def test_a_class_zip_of_folders_keeps_its_exec_bits(tmp_path: Path) -> None:
    files = {**below("hw/ann", package()), **below("hw/joe", package())}
    for given in downloaded(tmp_path, files, "zip").handed_in:
        node = take(given.path, modes_kept=given.modes_kept).file(NODE_PATH)
        assert node is not None
        assert node.mode & 0o100
        assert given.modes_kept


# Google Classroom


@pytest.mark.parametrize("way", WAYS)
def test_google_classrooms_files_have_the_students_names(tmp_path: Path, way: str) -> None:
    good = zipped(package())
    found = downloaded(
        tmp_path,
        {
            "김 민지 - my_robot_controller.zip": good,
            "Zoë Roe - week 2 - robot.zip": good,
            "Max Ray - notes.pdf": b"%PDF",
        },
        way,
    )
    assert found.system.name == "google_classroom"
    given = by_key(found)
    assert sorted(given) == ["Max Ray", "Zoë Roe", "김 민지"]
    assert all(is_marked(given[name][0]) for name in ("김 민지", "Zoë Roe"))
    assert not is_marked(given["Max Ray"][0])
    assert "no times of submission" in notes_of(found)


def test_archives_with_a_dash_in_one_students_name_are_not_google_classrooms(
    tmp_path: Path,
) -> None:
    files = {f"{name}.zip": zipped(package()) for name in ("ann - second try", "bo", "cy")}
    assert downloaded(tmp_path, files, "folder").system.name == "archives"
