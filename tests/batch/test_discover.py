"""Discovery of submissions in folders and archives: their students and the notes about them."""

from __future__ import annotations

import os
import shutil
import time
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings
from hypothesis import given as hypothetical
from hypothesis import strategies as st

from grader.base.errors import UsageError
from grader.base.shown import shown
from grader.batch.discover import discover
from grader.batch.model import ClassFolder, HandedIn
from grader.batch.systems.notes import printable

from .archives import NODE_PATH, PACKAGE, package, take, tarred, write, zipped


def found_in(path: Path, tmp_path: Path, system: str = "auto") -> ClassFolder:
    return discover(path, system=system, unpack=tmp_path / "work")


def submission_of(folder: ClassFolder, key: str) -> HandedIn:
    (found,) = [given for given in folder.handed_in if given.student.key == key]
    return found


def keys(folder: ClassFolder) -> list[str]:
    return [given.student.key for given in folder.handed_in]


def notes_of(folder: ClassFolder) -> str:
    return "\n".join(folder.notes)


@pytest.fixture
def course(tmp_path: Path) -> Path:
    """A class of three: a package, a workspace and an archive."""
    root = tmp_path / "course"
    write(root / "joe", package(below=f"ros2_ws/src/{PACKAGE}"))
    write(root / "ann lee", package())
    (root / "zoë.tar.gz").write_bytes(tarred(package(), "w:gz"))
    return root


def test_each_folder_and_each_archive_is_one_student(course: Path, tmp_path: Path) -> None:
    found = found_in(course, tmp_path)
    assert keys(found) == ["ann lee", "joe", "zoë"]
    assert [given.student.name for given in found.handed_in] == ["ann lee", "joe", "zoë"]
    assert (found.system.name, found.path, found.missing) == ("folders", course, ())
    assert submission_of(found, "zoë").path == course / "zoë.tar.gz"
    for work in found.handed_in:
        assert take(work.path).problem == ""
        assert (work.attempt, work.submitted, work.late) == (1, None, None)
    assert "folders" in notes_of(found)
    assert not (tmp_path / "work").exists()


def test_a_folder_of_archives_is_recognised_as_one(tmp_path: Path) -> None:
    for name in ("jane.zip", "joe.tar.xz"):
        (tmp_path / name).write_bytes(zipped(package()))
    found = found_in(tmp_path, tmp_path)
    assert (found.system.name, keys(found)) == ("archives", ["jane", "joe"])


def test_an_archive_without_an_extension_is_detected_by_content(
    course: Path, tmp_path: Path
) -> None:
    (course / "kim").write_bytes(zipped(package()))
    (course / "notes").write_text("to do\n")
    found = found_in(course, tmp_path)
    assert submission_of(found, "kim").path == course / "kim"
    assert "notes" in notes_of(found)


def test_other_files_are_reported_and_left_out(course: Path, tmp_path: Path) -> None:
    for name in (".git", "__MACOSX", "reports"):
        write(course / name, package())
    for name in (".DS_Store", "README.md", "grades.csv", "index.html", "jane.py"):
        (course / name).write_text("x")
    os.mkfifo(course / "pipe")
    found = found_in(course, tmp_path)
    assert keys(found) == ["ann lee", "joe", "zoë"]
    for name in (".git", "__MACOSX", "reports", ".DS_Store", "README.md", "grades.csv", "jane.py"):
        assert name in notes_of(found)
    assert "pipe" in notes_of(found)


def test_a_tilde_at_the_end_makes_a_file_a_backup_but_not_a_folder(
    course: Path, tmp_path: Path
) -> None:
    write(course / "kim~", package())
    (course / "lee.zip~").write_bytes(zipped(package()))
    found = found_in(course, tmp_path)
    assert keys(found) == ["ann lee", "joe", "kim~", "zoë"]
    assert "lee.zip~" in notes_of(found)


def test_the_folder_of_unpacked_archives_is_not_a_student(course: Path) -> None:
    found = discover(course, unpack=course / "out" / "work")
    (course / "out" / "work").mkdir(parents=True)
    assert keys(discover(course, unpack=course / "out" / "work")) == keys(found)


def test_an_archive_beside_the_folder_of_its_name_is_an_earlier_attempt(tmp_path: Path) -> None:
    write(tmp_path / "c" / "jane", package())
    (tmp_path / "c" / "jane.zip").write_bytes(zipped(package()))
    (tmp_path / "c" / "jane.tgz").write_bytes(tarred(package(), "w:gz"))
    os.utime(tmp_path / "c" / "jane.zip", (1, 1))
    found = found_in(tmp_path / "c", tmp_path)
    assert [(given.path.name, given.attempt) for given in found.handed_in] == [
        ("jane.zip", 1),
        ("jane.tgz", 2),
        ("jane", 3),
    ]
    assert set(keys(found)) == {"jane"}
    assert all("attempts of one student" in given.notes[0] for given in found.handed_in)


def test_a_link_in_place_of_a_submission_is_not_followed(course: Path, tmp_path: Path) -> None:
    (course / "eve").symlink_to("/etc")
    (course / "max.zip").symlink_to("gone.zip")
    found = found_in(course, tmp_path)
    assert "link" in submission_of(found, "eve").problem
    assert "link" in submission_of(found, "max").problem
    assert submission_of(found, "joe").problem == ""


def test_a_folder_around_the_class_is_entered(course: Path, tmp_path: Path) -> None:
    around = tmp_path / "downloads"
    (around / "hw1").mkdir(parents=True)
    shutil.move(course, around / "hw1" / "course")
    (around / ".DS_Store").write_text("")
    found = found_in(around, tmp_path)
    assert keys(found) == ["ann lee", "joe", "zoë"]
    assert submission_of(found, "joe").path == around / "hw1" / "course" / "joe"
    assert "the class is in the folder hw1" in notes_of(found)


def test_the_folder_of_the_only_student_is_not_entered(tmp_path: Path) -> None:
    """Its folders belong to the student: two differently named packages, or a workspace."""
    write(tmp_path / "a" / "jane", package(below=PACKAGE))
    other = package(below="other")
    other["other/package.xml"] = b"<package><name>other</name></package>"
    write(tmp_path / "a" / "jane", other)
    write(tmp_path / "b" / "joe", package(below=f"src/{PACKAGE}"))
    (tmp_path / "b" / "joe" / "build").mkdir()
    assert keys(found_in(tmp_path / "a", tmp_path)) == ["jane"]
    assert keys(found_in(tmp_path / "b", tmp_path)) == ["joe"]


@pytest.mark.parametrize("below", ["", PACKAGE, f"src/{PACKAGE}"])
def test_a_single_package_or_workspace_is_not_a_class(tmp_path: Path, below: str) -> None:
    write(tmp_path / "jane", package(below=below))
    (tmp_path / "jane.zip").write_bytes(zipped(package(below=below)))
    for name in ("jane", "jane.zip"):
        with pytest.raises(UsageError, match=r"is one (package|workspace)") as error:
            found_in(tmp_path / name, tmp_path)
        assert "grader grade" in error.value.remedy


def test_a_folder_without_submissions_lists_what_was_found(tmp_path: Path) -> None:
    (tmp_path / "c").mkdir()
    with pytest.raises(UsageError, match="nothing"):
        found_in(tmp_path / "c", tmp_path)
    (tmp_path / "c" / "grades.csv").write_text("a\n")
    with pytest.raises(UsageError, match=r"1 other file \(grades\.csv\)") as error:
        found_in(tmp_path / "c", tmp_path)
    for name in ("moodle", "canvas", "gradescope", "google_classroom", "folders", "archives"):
        assert name in error.value.remedy


@pytest.mark.parametrize("name", ["gone", "a\0b", "file.txt"])
def test_a_path_that_is_not_a_class_is_a_usage_error(tmp_path: Path, name: str) -> None:
    (tmp_path / "file.txt").write_text("x")
    with pytest.raises(UsageError):
        found_in(tmp_path / name, tmp_path)


def test_an_unknown_system_is_a_usage_error(course: Path, tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="no system 'modle'") as error:
        found_in(course, tmp_path, "modle")
    assert "did you mean 'moodle'?" in error.value.remedy
    with pytest.raises(UsageError, match="is not Moodle's download"):
        found_in(course, tmp_path, "moodle")


def test_a_system_can_be_forced(tmp_path: Path) -> None:
    write(tmp_path / "c" / "Jane Roe_12_assignsubmission_file", package())
    assert found_in(tmp_path / "c", tmp_path).system.name == "moodle"
    found = found_in(tmp_path / "c", tmp_path, "folders")
    assert (found.system.name, keys(found)) == ("folders", ["Jane Roe_12_assignsubmission_file"])
    assert "as requested" in notes_of(found)


# exec bits


def test_exec_bits_are_unknown_if_no_student_has_any(tmp_path: Path) -> None:
    """They were lost in transfer, unless at least one student has an exec bit."""
    for name in ("ann", "joe"):
        write(tmp_path / "c" / name, package())
        (tmp_path / "c" / name / NODE_PATH).chmod(0o644)
    found = found_in(tmp_path / "c", tmp_path)
    assert [given.modes_kept for given in found.handed_in] == [False, False]
    assert "executable" in notes_of(found)
    write(tmp_path / "c" / "kim", package())
    found = found_in(tmp_path / "c", tmp_path)
    assert [given.modes_kept for given in found.handed_in] == [True, True, True]
    assert "executable" not in notes_of(found)


def test_exec_bits_are_missing_if_other_students_have_them(tmp_path: Path) -> None:
    write(tmp_path / "c" / "ann", package())
    (tmp_path / "c" / "ann" / NODE_PATH).chmod(0o644)
    (given,) = found_in(tmp_path / "c", tmp_path).handed_in
    assert given.modes_kept


# arbitrary names

NAME = st.one_of(
    st.text(min_size=1, max_size=40),
    st.binary(min_size=1, max_size=40).map(os.fsdecode),
    st.builds(
        "{}_{}{}".format,
        st.sampled_from(["Jane Roe", "doejane_LATE", "doejane", "", "submission", "hw1-joe"]),
        st.sampled_from(["12", "12_34", "x"]),
        st.sampled_from(
            ["_assignsubmission_file", "_assignsubmission_file_a.zip", "_a.zip", "_text.html", ""]
        ),
    ),
).filter(lambda name: name not in (".", "..") and not set(name) & set("/\0"))


@settings(max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture])
@hypothetical(folders=st.sets(NAME, max_size=6), files=st.sets(NAME, max_size=6))
def test_no_submission_is_lost_because_of_its_name(
    tmp_path: Path, folders: set[str], files: set[str]
) -> None:
    root = tmp_path / "class"
    shutil.rmtree(root, ignore_errors=True)
    root.mkdir()
    made = set()
    for name in sorted(folders):
        try:
            (root / name).mkdir()
            (root / name / "setup.py").write_text("")
            made.add(name)
        except (OSError, UnicodeEncodeError):
            continue  # not a valid name on this file system
    for name in sorted(files):
        try:
            if not os.path.lexists(root / name):
                (root / name).write_bytes(b"PK\x03\x04")
                made.add(name)
        except (OSError, UnicodeEncodeError):
            continue
    try:
        found = found_in(root, tmp_path)
    except UsageError as error:
        assert not [name for name in made if (root / name).is_dir() and name[0] != "."] or (
            "is one" in error.message
        )
        return
    taken = {given.path.name for given in found.handed_in}
    for work in found.handed_in:
        taken |= {path.name for path in work.path.iterdir()} if work.path.is_dir() else set()
        for text in (*work.notes, work.student.key, work.student.name):
            text.encode()
    for name in made:
        gathered = any(name.endswith(part) for part in taken if part)
        assert gathered or shown(printable(name)) in notes_of(found) + str(found.handed_in)
    attempts = [(given.student.key, given.attempt) for given in found.handed_in]
    assert len(attempts) == len(set(attempts))


def test_two_hundred_submissions_are_found_quickly(tmp_path: Path) -> None:
    for n in range(200):
        write(tmp_path / "c" / f"student{n:03}", package(below=PACKAGE))
        (tmp_path / "c" / f"student{n:03}" / PACKAGE / NODE_PATH).chmod(0o644)
    begin = time.process_time()
    found = found_in(tmp_path / "c", tmp_path)
    assert time.process_time() - begin < 0.3
    assert len(found.handed_in) == 200
