"""Intake of real folders: finding the package and choosing between several."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

from grader.base.errors import UsageError
from grader.base.i18n.message import Message
from grader.package.submission import take_in

from .small_package import NODE, NODE_PATH, PACKAGE, make, paths, take, write


@pytest.mark.parametrize("place", [".", PACKAGE, f"src/{PACKAGE}", f"week 1/ros2/ä/{PACKAGE}"])
def test_the_package_is_found_in_any_folder(tmp_path: Path, place: str) -> None:
    make(tmp_path / "jane" / place)
    found = take(tmp_path / "jane")
    assert found.root == place
    assert [(c.path, c.name) for c in found.candidates] == [(place, PACKAGE)]
    assert not found.problem
    assert not found.notes
    node = found.file(NODE_PATH)
    assert node is not None
    assert node.data == b"#!/usr/bin/env python3\n"
    assert node.mode == 0o755
    assert found.file("gone") is None
    assert [file.path for file in found.files] == sorted(paths(found))
    assert found.name == "jane"
    assert (found.origin, found.modes) == ("directory", "recorded")


def test_a_path_through_a_link_is_the_target_folder(tmp_path: Path) -> None:
    make(tmp_path / "jane")
    (tmp_path / "link").symlink_to("jane")
    assert take(tmp_path / "link").name == "jane"


@pytest.mark.parametrize(
    ("make_it", "words"),
    [
        (lambda p: None, "there is no file or folder"),
        (lambda p: p.write_text("x"), "neither a folder nor an archive"),
        (os.mkfifo, "neither a folder nor a file"),
        (lambda p: p.symlink_to(p), "cannot be read"),
        (lambda p: p.symlink_to("gone"), "there is no file or folder"),
    ],
)
def test_a_path_that_is_not_a_folder_is_a_usage_error(
    tmp_path: Path, make_it: object, words: str
) -> None:
    path = tmp_path / "thing"
    make_it(path)  # type: ignore[operator]
    with pytest.raises(UsageError, match=words) as caught:
        take(path)
    assert caught.value.exit_status == 2


def test_one_file_of_a_package_is_answered_with_its_folder(tmp_path: Path) -> None:
    make(tmp_path / "jane")
    file = next(path for path in (tmp_path / "jane").rglob("setup.py"))
    with pytest.raises(UsageError, match="is one file of a package") as caught:
        take(file)
    assert caught.value.remedy == f"Give the folder of the package: {file.parent}"


@pytest.mark.parametrize(
    ("given", "meant"),
    [("jnae", "jane"), ("jane.", "jane"), ("Jane", "jane"), ("jane2/src", "jane/src"),
     ("jane/scr/p", "jane/src/p"), ("jnae/lost", "jane")],
)  # fmt: skip
def test_a_path_misspelt_by_a_letter_has_a_suggestion(
    given: str, meant: str, tmp_path: Path
) -> None:
    (tmp_path / "jane/src/p").mkdir(parents=True)
    with pytest.raises(UsageError, match="there is no file or folder") as caught:
        take(tmp_path / given)
    assert f"(did you mean '{tmp_path / meant}'?)" in caught.value.message


def test_a_path_that_is_like_no_other_has_no_suggestion(tmp_path: Path) -> None:
    (tmp_path / "jane").mkdir()
    with pytest.raises(UsageError) as caught:
        take(tmp_path / "mohammed")
    assert "did you mean" not in caught.value.message


def test_an_unreadable_folder_is_a_usage_error(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(path: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(os, "scandir", refuse)
    with pytest.raises(UsageError, match="Permission denied") as caught:
        take(tmp_path)
    assert isinstance(caught.value.message, Message)  # it can be translated
    with pytest.raises(UsageError, match="null"):
        take(Path("a\0b"))
    with pytest.raises(UsageError, match="File name too long"):
        take(Path("a" * 300))


# which package


def test_the_package_with_the_right_name_is_chosen_of_several(tmp_path: Path) -> None:
    make(tmp_path / "src/a", "another")
    make(tmp_path / "src/b")
    make(tmp_path / "src/c", "third")
    assert take(tmp_path).root == "src/b"


def test_the_name_comes_from_the_manifest_then_setup_py_then_the_folder(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    (tmp_path / "a/setup.py").write_text(f"n = '{PACKAGE}'\nsetup(name=n)\n")
    assert take(tmp_path).candidates[0].name == PACKAGE
    (tmp_path / "a/package.xml").write_text("<package><name> from_xml\n</name>")  # never closed
    assert take(tmp_path).candidates[0].name == "from_xml"
    (tmp_path / "a/package.xml").write_text("<package>")
    (tmp_path / "a/setup.py").write_text("setup(name=compute())")
    assert take(tmp_path).candidates[0].name == "a"


def test_two_packages_with_the_right_name_are_a_mistake_that_names_both(tmp_path: Path) -> None:
    make(tmp_path / "src/b")
    make(tmp_path / "src/c")
    found = take(tmp_path)
    assert found.root is None
    assert not found.files
    assert found.problem_mistake == "package.duplicate"
    assert "src/b" in found.problem
    assert "src/c" in found.problem
    (tmp_path / "src/c/COLCON_IGNORE").touch()
    assert take(tmp_path).root == "src/b"


@pytest.mark.parametrize(
    ("meant", "copy"),
    [
        (PACKAGE, f"{PACKAGE}_old"),
        (PACKAGE, f"{PACKAGE} copy"),
        (PACKAGE, f"{PACKAGE} - Copy (2)"),
        (PACKAGE, f"Copy of {PACKAGE}"),
        (PACKAGE, f"{PACKAGE}(1)"),
        (PACKAGE, f"{PACKAGE} - 복사본"),
        (PACKAGE, f"old/{PACKAGE}"),
        (f"{PACKAGE}_final", f"{PACKAGE}.bak"),
        ("src", "before/src"),
    ],
)
def test_a_package_beside_a_folder_named_like_a_copy_is_the_one_that_is_meant(
    meant: str, copy: str, tmp_path: Path
) -> None:
    make(tmp_path / "ws" / meant)
    make(tmp_path / "ws" / copy)
    found = take(tmp_path)
    assert (found.root, found.copies) == (f"ws/{meant}", (f"ws/{copy}",))


@pytest.mark.parametrize("other", ["bold", "holder", "scopy", f"{PACKAGE}2"])
def test_a_folder_is_no_copy_because_its_name_contains_the_letters(
    other: str, tmp_path: Path
) -> None:
    make(tmp_path / "ws" / PACKAGE)
    make(tmp_path / "ws" / other)
    assert take(tmp_path).problem_mistake == "package.duplicate"


def test_of_two_packages_the_complete_one_is_meant(tmp_path: Path) -> None:
    make(tmp_path / "ws/a")
    make(tmp_path / "ws/b")
    (tmp_path / "ws/a" / NODE_PATH).write_text("")
    assert take(tmp_path).root == "ws/b"
    (tmp_path / "ws/b/setup.cfg").unlink(missing_ok=True)
    (tmp_path / "ws/a/setup.cfg").touch()
    assert take(tmp_path).root is None, "each has what the other lacks"


def test_a_package_inside_another_is_explained_as_colcon_treats_it(tmp_path: Path) -> None:
    make(tmp_path / "one")
    make(tmp_path / "one" / "again" / PACKAGE)
    found = take(tmp_path)
    assert found.root == "one"
    assert "never builds the inner" in found.hints[0]
    make(tmp_path / "two/outer", "outer")
    make(tmp_path / "two/outer/inner")
    found = take(tmp_path / "two")
    assert found.root == "outer/inner"
    assert "is inside another package (outer, in outer)" in found.hints[0]


def test_the_only_package_is_chosen_whatever_its_name(tmp_path: Path) -> None:
    make(tmp_path / "a", "my_robot")
    found = take(tmp_path)
    assert found.root == "a"
    assert found.candidates[0].name == "my_robot"
    assert not found.hints


def test_of_several_wrong_packages_the_one_with_the_node_or_nearest_name_is_chosen(
    tmp_path: Path,
) -> None:
    make(tmp_path / "a", "alpha")
    make(tmp_path / "b", "my_robot_controler")
    found = take(tmp_path)
    assert found.root == "b"
    assert "alpha (a)" in found.hints[0]
    (tmp_path / "b" / NODE_PATH).unlink()
    assert take(tmp_path).root == "a"


def test_a_package_with_colcon_ignore_is_marked_with_a_hint(tmp_path: Path) -> None:
    make(tmp_path / "src/a")
    (tmp_path / "src/COLCON_IGNORE").touch()
    found = take(tmp_path)
    assert found.root == "src/a"
    assert "0 packages finished" in found.hints[0]


@pytest.mark.parametrize(
    ("files", "mistake", "words"),
    [
        ([], "package.empty", "is empty"),
        ([NODE], "package.only_node", NODE),
        (["notes.txt", "a/b.py"], "package.no_manifest", "a/b.py, notes.txt"),
        (["p/Package.xml"], "package.manifest_renamed", "p/Package.xml"),
        (["p/setup.py.txt"], "package.manifest_renamed", "p/setup.py.txt"),
        (["my.zip"], "package.archive_inside", "my.zip"),
        (["my.tar.gz", "my.xz"], "package.archive_inside", "my."),
        (["my.gz"], "package.archive_inside", "my.gz"),
        (["my.bz2"], "package.archive_inside", "my.bz2"),
        (["my.txz"], "package.archive_inside", "my.txz"),
        (["my.tbz"], "package.archive_inside", "my.tbz"),
        (["build/COLCON_IGNORE", "log/x"], "package.only_build", "build/"),
    ],
)
def test_without_a_package_the_found_files_are_listed(
    tmp_path: Path, files: list[str], mistake: str, words: str
) -> None:
    write(tmp_path, files)
    found = take(tmp_path)
    assert (found.root, found.problem_mistake) == (None, mistake)
    assert words in found.problem
    assert found.problem_fix
    assert len(found.sha256) == 64


def test_a_link_in_place_of_the_package_is_reported(tmp_path: Path) -> None:
    make(tmp_path / "elsewhere")
    (tmp_path / "given").mkdir()
    (tmp_path / "given" / PACKAGE).symlink_to(tmp_path / "elsewhere")
    found = take(tmp_path / "given")
    assert found.problem_mistake == "package.link"
    assert PACKAGE in found.problem


def test_a_package_that_was_created_inside_itself_is_not_to_be_put_beside_it(
    tmp_path: Path,
) -> None:
    make(tmp_path / "one")
    make(tmp_path / "one" / PACKAGE / PACKAGE)
    (hint,) = take(tmp_path).hints
    assert "of the same name inside this one" in hint
    assert "side by side" not in hint
    make(tmp_path / "two")
    make(tmp_path / "two" / PACKAGE / "other", "other")
    (hint,) = take(tmp_path / "two").hints
    assert "Put packages side by side in src" in hint


@pytest.mark.parametrize("folder", [".", PACKAGE])
def test_a_build_inside_the_package_is_told_of(folder: str, tmp_path: Path) -> None:
    make(tmp_path / "src" / PACKAGE)
    for name in ("build", "install", "log"):
        there = tmp_path / "src" / PACKAGE / folder / name
        there.mkdir(parents=True)
        (there / "COLCON_IGNORE").touch()
    (hint,) = take(tmp_path, at_work=True).hints
    place = "" if folder == "." else f"{PACKAGE}/"
    assert f"rm -r {place}build {place}install {place}log" in hint
    assert take(tmp_path / "src" / PACKAGE).hints == (hint,)


def test_a_build_in_the_workspace_or_by_setup_py_gets_no_advice(tmp_path: Path) -> None:
    make(tmp_path / "src" / PACKAGE)
    for name in ("build", "install", "log"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "COLCON_IGNORE").touch()
    (tmp_path / "src" / PACKAGE / "build" / "lib").mkdir(parents=True)
    assert take(tmp_path, at_work=True).hints == ()


@pytest.mark.parametrize(
    "place",
    [f"src/{PACKAGE}", f"a/b/c/{PACKAGE}", f"{PACKAGE}/week_1", f"Desktop/ros2_ws/src/{PACKAGE}"],
)
def test_folders_around_the_package_are_told_of(tmp_path: Path, place: str) -> None:
    make(tmp_path / "jane" / place)
    (hint,) = take(tmp_path / "jane").hints
    assert f"hand in only {place}, without" in hint
    assert take(tmp_path / "jane", at_work=True).hints == ()
    archive = shutil.make_archive(str(tmp_path / "hw"), "zip", tmp_path / "jane")
    assert take(Path(archive)).hints == (hint,)
    (tmp_path / "ann").mkdir()
    (tmp_path / "hw.zip").rename(tmp_path / "ann" / "hw.zip")
    assert take(tmp_path / "ann").hints == (hint,)


def test_a_workspace_that_was_handed_in_is_told_of(tmp_path: Path) -> None:
    make(tmp_path / "ws" / "src" / PACKAGE)
    for name in ("build", "install", "log"):
        (tmp_path / "ws" / name).mkdir()
        (tmp_path / "ws" / name / "COLCON_IGNORE").touch()
    (hint,) = take(tmp_path).hints
    assert f"hand in only ws/src/{PACKAGE}. Leave out build, install and log" in hint


def test_a_folder_of_the_packages_name_is_meant_to_be_the_package(tmp_path: Path) -> None:
    make(tmp_path / PACKAGE / PACKAGE)
    (hint,) = take(tmp_path / PACKAGE).hints
    assert f"hand in only {PACKAGE}, without" in hint
    assert take(tmp_path / PACKAGE / PACKAGE).hints == ()


@pytest.mark.parametrize("place", [".", PACKAGE, "work", f"hello-main/{PACKAGE}", "hello-main"])
def test_the_usual_places_of_a_package_get_no_advice(tmp_path: Path, place: str) -> None:
    make(tmp_path / "jane" / place)
    assert take(tmp_path / "jane").hints == ()


def test_a_repository_may_have_folders_around_the_package(tmp_path: Path) -> None:
    make(tmp_path / "src" / PACKAGE)
    subprocess.run(["git", "init", "-q", tmp_path], check=True)
    assert take(tmp_path).hints == ()


def test_packages_side_by_side_are_named_together(tmp_path: Path) -> None:
    make(tmp_path / "src" / PACKAGE)
    make(tmp_path / "src" / "other", "other")
    found = take_in(tmp_path, package=PACKAGE, node_file=NODE, others=["other"])
    assert found.hints == ()  # (one folder must hold both)
    (tmp_path / "ws").mkdir()
    (tmp_path / "src").rename(tmp_path / "ws" / "src")
    found = take_in(tmp_path, package=PACKAGE, node_file=NODE, others=["other"])
    (hint,) = found.hints
    assert f"ws/src/{PACKAGE}, ws/src/other in them were marked" in hint
    for name in ("build", "install", "log"):
        (tmp_path / "ws" / name).mkdir()
        (tmp_path / "ws" / name / "COLCON_IGNORE").touch()
    found = take_in(tmp_path, package=PACKAGE, node_file=NODE, others=["other"])
    (hint,) = found.hints
    assert hint.startswith("A whole workspace") and "other in it were marked" in hint


def test_a_folder_of_the_main_packages_name_may_hold_several_packages(tmp_path: Path) -> None:
    make(tmp_path / PACKAGE / PACKAGE)
    make(tmp_path / PACKAGE / "other", "other")
    found = take_in(tmp_path / PACKAGE, package=PACKAGE, node_file=NODE, others=["other"])
    assert found.hints == ()


@pytest.mark.parametrize("folder", [".backup", ".old/deeper"])
def test_a_package_in_a_hidden_folder_is_none_as_for_colcon(folder: str, tmp_path: Path) -> None:
    make(tmp_path / "src/my_robot_controller")
    make(tmp_path / folder / "my_robot_controller")
    taken = take(tmp_path)
    assert taken.root == "src/my_robot_controller"
    assert [one.path for one in taken.candidates] == ["src/my_robot_controller"]
    assert taken.copies == ()


def test_a_hidden_folder_may_be_the_workspace(tmp_path: Path) -> None:
    make(tmp_path / ".ws/src/my_robot_controller")
    taken = take(tmp_path)
    assert taken.root == ".ws/src/my_robot_controller"
    assert any("folder .ws. colcon does not look" in hint for hint in taken.hints)


def test_the_old_files_of_a_fix_are_part_of_nothing(tmp_path: Path) -> None:
    before = take(make(tmp_path / "jane"))
    for name in ("package.xml", "setup.py", NODE_PATH):
        path = tmp_path / "jane" / name
        for number in (1, 2):
            shutil.copy(path, path.with_name(f"{path.name}.~{number}~"))
    after = take(tmp_path / "jane")
    assert (after.sha256, after.candidates) == (before.sha256, before.candidates)
    assert after.hints == before.hints
