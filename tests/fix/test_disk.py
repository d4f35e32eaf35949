"""Writing to the student's own copy: all or nothing, with backups, never through a link."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from grader.base.errors import UsageError
from grader.package.edit import disk
from grader.package.edit.disk import apply
from grader.package.edit.files import Files
from grader.package.edit.tree import Chmod, Delete, Move, Replace
from tests.corpus.model import MANIFEST, MARKER, NODE, SETUP
from tests.fix.corpus_fixes import contents, edited, plan_of
from tests.marking import taken_in

NAME = Replace(MANIFEST, "<name>my_robot_controller<", "<name>my_robot_controler<")
ENTRY = Replace(SETUP, "my_first_node:main", "my_frist_node:main")


def tree(root: Path) -> dict[str, tuple[bytes, int]]:
    """Return everything in a folder, with modes."""
    return {
        str(path.relative_to(root)): (
            str(path.readlink()).encode() if path.is_symlink() else path.read_bytes(),
            path.lstat().st_mode,
        )
        for path in sorted(root.rglob("*"))
        if not path.is_dir() or path.is_symlink()
    }


def write_plan(root: Path) -> list[str]:
    plan = plan_of(root)
    return apply(plan.old, plan.new, root)


def test_the_package_matches_the_plan_and_old_files_are_backed_up(tmp_path: Path) -> None:
    root = edited(tmp_path, NAME, ENTRY, Delete(MARKER), Chmod(NODE, 0o640))
    (root / MANIFEST).chmod(0o660)
    before = tree(root)
    plan = plan_of(root)
    backups = apply(plan.old, plan.new, root)
    assert backups == [f"{MANIFEST}.~1~", f"{SETUP}.~1~"]
    after = taken_in(root)
    assert {f.path: f.data for f in after.files if f.kind == "file"} == contents(plan.new)
    for path in (MANIFEST, SETUP):
        assert (root / f"{path}.~1~").read_bytes() == before[path][0]
        assert (root / path).stat().st_mode == before[path][1]
    assert (root / NODE).stat().st_mode & 0o777 == 0o750
    assert plan_of(root).patch == b""


def test_a_second_backup_does_not_replace_the_first(tmp_path: Path) -> None:
    root = edited(tmp_path, NAME)
    (root / f"{MANIFEST}.~1~").write_text("an older one")
    assert write_plan(root) == [f"{MANIFEST}.~2~"]
    assert (root / f"{MANIFEST}.~1~").read_text() == "an older one"


def test_a_moved_file_is_removed_from_its_old_place(tmp_path: Path) -> None:
    root = edited(tmp_path, Move(NODE, "scripts/my_first_node.py"))
    write_plan(root)
    assert not (root / "scripts/my_first_node.py").exists()
    assert (root / NODE).stat().st_mode & 0o111


def _read_only(root: Path) -> None:
    (root / SETUP).chmod(0o444)


def _changed(root: Path) -> None:
    (root / SETUP).write_text("# somebody is typing\n")


def _gone(root: Path) -> None:
    (root / SETUP).unlink()


def _link(root: Path) -> None:
    (root / SETUP).rename(root.parent / "setup.py")
    (root / SETUP).symlink_to(root.parent / "setup.py")


def _marker_there(root: Path) -> None:
    (root / MARKER).parent.mkdir()
    (root / MARKER).write_text("made meanwhile")


def _resource_is_a_link(root: Path) -> None:
    (root.parent / "elsewhere").mkdir(exist_ok=True)
    (root / "resource").symlink_to(root.parent / "elsewhere")


@pytest.mark.parametrize(
    ("meanwhile", "output"),
    [
        (_read_only, "read-only"),
        (_changed, "has changed since"),
        (_gone, "No such file"),
        (_link, "it is a link"),
        (_marker_there, "did not exist"),
        (_resource_is_a_link, "link"),
    ],
)
def test_an_unwritable_file_is_refused_and_nothing_is_written(
    meanwhile: Callable[[Path], None], output: str, tmp_path: Path
) -> None:
    root = edited(tmp_path, NAME, ENTRY, Delete(MARKER))
    plan = plan_of(root)
    meanwhile(root)
    before = tree(tmp_path)
    with pytest.raises(UsageError, match=output) as caught:
        apply(plan.old, plan.new, root)
    assert "Nothing was written" in str(caught.value)
    assert tree(tmp_path) == before


@pytest.mark.parametrize(
    ("failure", "raised"),
    [
        (OSError(28, "No space left on device"), UsageError),
        (KeyboardInterrupt(), KeyboardInterrupt),
    ],
    ids=["disk full", "Ctrl+C"],
)
def test_a_failure_half_way_restores_everything(
    failure: BaseException,
    raised: type[BaseException],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    edits = (NAME, ENTRY, Delete(MARKER), Move(NODE, "scripts/my_first_node.py"))
    root = edited(tmp_path, *edits)
    plan = plan_of(root)
    before = tree(root)
    rename = os.rename

    def full(old: str, new: str, **folders: int) -> None:
        if new == SETUP:  # the last file by name
            raise failure
        rename(old, new, **folders)

    monkeypatch.setattr(os, "rename", full)
    with pytest.raises(raised):
        apply(plan.old, plan.new, root)
    assert tree(root) == before


def test_an_error_names_the_files_that_could_not_be_restored(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    root = edited(tmp_path, NAME, ENTRY)
    plan = plan_of(root)
    before = tree(root)
    rename = os.rename

    def full(old: str, new: str, **folders: int) -> None:
        if new == SETUP or old.endswith(".~1~"):
            raise OSError(28, "No space left on device")
        rename(old, new, **folders)

    monkeypatch.setattr(os, "rename", full)
    with pytest.raises(UsageError) as caught:
        apply(plan.old, plan.new, root)
    assert "Nothing was written" not in str(caught.value)
    assert f"could not be restored, check them: {MANIFEST}." in caught.value.remedy
    assert (root / f"{MANIFEST}.~1~").read_bytes() == before[MANIFEST][0]


def test_a_mode_that_cannot_be_set_brings_the_old_bytes_back(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    root = edited(tmp_path)
    old = Files.of(taken_in(root))
    new = old.with_data(NODE, b"#!/usr/bin/env python3\n").with_mode(NODE, 0o700)
    before = tree(root)

    fchmod = os.fchmod

    def refuse(handle: int, mode: int) -> None:
        if mode == 0o700:
            raise OSError(1, "Operation not permitted")
        fchmod(handle, mode)

    monkeypatch.setattr(os, "fchmod", refuse)
    with pytest.raises(UsageError, match="Nothing was written"):
        apply(old, new, root)
    assert tree(root) == before


def test_the_last_backup_is_the_one_that_the_limit_allows(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(disk, "MOST_BACKUPS", 2)
    root = edited(tmp_path, NAME)
    plan = plan_of(root)
    (root / f"{MANIFEST}.~1~").write_text("an older one")
    assert apply(plan.old, plan.new, root) == [f"{MANIFEST}.~2~"]
    (root / MANIFEST).write_bytes(plan.old.data(MANIFEST) or b"")
    with pytest.raises(UsageError, match="there are 2 backups of it already"):
        apply(plan.old, plan.new, root)


def test_a_plan_with_a_path_out_of_the_package_is_refused(tmp_path: Path) -> None:
    root = edited(tmp_path)
    old = Files.of(taken_in(root))
    for path in ("../outside.txt", "a/../../outside.txt", "/outside.txt"):
        with pytest.raises(UsageError):
            apply(old, old.with_data(path, b"x"), root)
    assert not (tmp_path / "outside.txt").exists()


def test_hard_links_to_a_file_keep_its_old_bytes(tmp_path: Path) -> None:
    root = edited(tmp_path, NAME)
    os.link(root / MANIFEST, tmp_path / "another name")
    old = (root / MANIFEST).read_bytes()
    write_plan(root)
    assert (tmp_path / "another name").read_bytes() == old != (root / MANIFEST).read_bytes()


def test_a_link_in_the_package_is_never_fixed(tmp_path: Path) -> None:
    root = edited(tmp_path, ENTRY)
    (root / SETUP).rename(root / "real_setup.txt")
    (root / SETUP).symlink_to("real_setup.txt")
    plan = plan_of(root)
    assert plan.patch == b""
    assert [finding.check for finding in plan.left] == ["entry_point.mapping"]
