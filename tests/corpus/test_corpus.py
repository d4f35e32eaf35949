"""The corpus itself: its edits apply and its points add up. Verdicts are tested elsewhere."""

from __future__ import annotations

import ast
import stat
from pathlib import Path

import pytest

from grader.package.edit.tree import Chmod, Crlf, EditError, Link, Nest, Replace

from .broken import BROKEN
from .build import SOLUTION, write
from .hostile import HOSTILE
from .model import NODE, POINTS, SETUP, Package
from .right import RIGHT

CORPUS = (*RIGHT, *BROKEN, *HOSTILE)
PARTS = {"right": RIGHT, "broken": BROKEN, "hostile": HOSTILE}


@pytest.mark.parametrize("packages", PARTS.values(), ids=PARTS)
def test_all_edits_apply(
    packages: tuple[Package, ...], tmp_path: Path, subtests: pytest.Subtests
) -> None:
    for package in packages:
        with subtests.test(package.name):
            assert write(package, tmp_path / package.name).is_dir()


def test_right_packages_parse_and_are_executable(tmp_path: Path, subtests: pytest.Subtests) -> None:
    for package in RIGHT:
        with subtests.test(package.name):
            root = write(package, tmp_path / package.name)
            nests = [root / edit.folder for edit in package.edits if isinstance(edit, Nest)]
            root = (nests or [root])[0]
            for path in (root / SETUP, root / NODE):
                ast.parse(path.read_bytes())
            assert (root / NODE).stat().st_mode & stat.S_IXUSR


def test_each_names_checks_of_the_assignment_once(subtests: pytest.Subtests) -> None:
    for package in CORPUS:
        with subtests.test(package.name):
            groups = (set(package.expect_failed), package.blocked, package.undecided)
            named_checks = [check for group in groups for check in group]
            assert len(named_checks) == len(set(named_checks)), "a check has one outcome"
            assert set(named_checks) <= set(POINTS)


@pytest.mark.parametrize(
    ("name", "score"),
    [
        ("empty_folder", 0),
        ("entry_missing", 45),
        ("exec_bit_missing", 90),
        ("spin_missing", 60),
        ("timer_missing", 83),
        ("tutorial", 100),
        ("fork_bomb", None),
    ],
)
def test_the_expected_score_follows_from_points_and_dependencies(
    name: str, score: float | None
) -> None:
    assert [p.expect_score for p in CORPUS if p.name == name] == [score]


def test_names_are_unique_and_valid_folder_names() -> None:
    names = [package.name for package in CORPUS]
    assert len(names) == len(set(names))
    assert all(name.isidentifier() and name.islower() for name in names)


def test_there_are_enough_of_each() -> None:
    assert len(RIGHT) >= 12
    assert len(BROKEN) >= 30
    assert len(HOSTILE) >= 10
    assert all(package.expect_failed for package in BROKEN)
    assert all(package.hostile for package in HOSTILE)


def test_every_check_fails_somewhere() -> None:
    failed = {check for package in CORPUS for check in package.expect_failed}
    assert failed >= set(POINTS)


def test_an_edit_that_does_not_fit_is_an_error(tmp_path: Path) -> None:
    for text in ("not there", "self"):
        package = Package(name=f"edit_{text[:3]}", edits=(Replace(NODE, text, "x"),))
        with pytest.raises(EditError, match="not once"):
            write(package, tmp_path)


def test_modes_line_ends_and_links_are_written(tmp_path: Path) -> None:
    edits = (Chmod(NODE, 0o640), Crlf(SETUP), Link("out", "/nowhere"))
    root = write(Package(name="edited", edits=edits), tmp_path)
    assert (root / NODE).stat().st_mode & 0o777 == 0o640
    assert (root / SETUP).read_bytes().count(b"\r\n") == len((SOLUTION / SETUP).open().readlines())
    assert (root / "out").is_symlink()


def test_the_solution_is_written_unchanged(tmp_path: Path) -> None:
    root = write(Package(name="solution", edits=()), tmp_path)
    for path in root.rglob("*"):
        if path.is_file():
            assert path.read_bytes() == (SOLUTION / path.relative_to(root)).read_bytes()
    assert (SOLUTION / NODE).stat().st_mode & stat.S_IXUSR
