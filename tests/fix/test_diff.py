"""Diffs: git and patch recreate any new bytes from them."""

from __future__ import annotations

import subprocess
import tempfile
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grader.package.edit.diff import diff
from grader.package.edit.files import Files
from grader.package.intake.model import SourceFile
from tests.fix.corpus_fixes import TOOLS

LINE = st.sampled_from([b"a", b"b", b"", b"\t x", b"c\r", b"f\xfcr", b"-- a", b"++ b", b"\\ No"])
DATA = st.lists(LINE, max_size=30).map(b"\n".join)
NAMES = ("plain.py", "with blank.py", "mit ä.py", 'quote".py', "back\\slash.py")


def files(found: dict[str, bytes], mode: int = 0o644) -> Files:
    return Files({path: SourceFile(path, "file", mode, data) for path, data in found.items()})


def made_by(tool: tuple[str, ...], old: dict[str, bytes], patch: bytes) -> dict[str, bytes]:
    """Return the files that a tool makes of the old ones by applying a patch."""
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for path, found in old.items():
            (root / path).write_bytes(found)
        done = subprocess.run(tool, cwd=root, input=patch, capture_output=True, check=False)
        assert done.returncode == 0, (patch, done.stdout + done.stderr)
        return {path.name: path.read_bytes() for path in root.iterdir() if path.is_file()}


@settings(max_examples=60)
@given(old=DATA, new=DATA)
@pytest.mark.parametrize("tool", TOOLS, ids=lambda tool: str(tool[0]))
def test_a_diff_turns_any_bytes_into_any_others(
    tool: tuple[str, ...], old: bytes, new: bytes
) -> None:
    patch = diff(files({"f": old}), files({"f": new}))
    if old == new:
        assert patch == b""
    else:
        assert made_by(tool, {"f": old}, patch) == {"f": new}


@pytest.mark.parametrize("tool", TOOLS, ids=lambda tool: str(tool[0]))
@pytest.mark.parametrize("name", NAMES)
def test_a_diff_keeps_any_file_name(name: str, tool: tuple[str, ...]) -> None:
    patch = diff(files({name: b"one\n"}), files({name: b"two\n"}))
    assert made_by(tool, {name: b"one\n"}, patch) == {name: b"two\n"}


@pytest.mark.parametrize("tool", TOOLS, ids=lambda tool: str(tool[0]))
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("changed", [True, False])
def test_a_file_moves_with_or_without_changes(
    name: str, tool: tuple[str, ...], changed: bool
) -> None:
    old = files({name: b"one\ntwo\n"})
    new = old.with_move(name, "new name.py")
    new = new.with_data("new name.py", b"one\n2\n") if changed else new
    made = made_by(tool, {name: b"one\ntwo\n"}, diff(old, new))
    assert made == {"new name.py": b"one\n2\n" if changed else b"one\ntwo\n"}


def test_a_file_moved_there_and_back_gives_no_diff() -> None:
    old = files({"a": b"1\n"})
    assert diff(old, old.with_move("a", "b").with_move("b", "a")) == b""


@pytest.mark.parametrize("tool", TOOLS, ids=lambda tool: str(tool[0]))
def test_a_change_of_files_that_were_moved_before_is_one_diff(tool: tuple[str, ...]) -> None:
    old = files({"a.py": b"one\n", "setup.py": b"two\n"})
    moved = old.with_move("a.py", "b.py")
    later = Files(moved.by_path).with_data("setup.py", b"three\n").with_move("b.py", "c.py")
    new = later.moved_since(moved)
    assert new.moved == {"c.py": "a.py"}
    assert made_by(tool, {"a.py": b"one\n", "setup.py": b"two\n"}, diff(old, new)) == {
        "c.py": b"one\n",
        "setup.py": b"three\n",
    }


def test_modes_are_the_two_that_git_records() -> None:
    old = files({"a": b"1\n"}, mode=0o640)
    assert diff(old, old.with_mode("a", 0o750)) == (
        b"diff --git a/a b/a\nold mode 100644\nnew mode 100755\n"
    )
    assert diff(old, old.with_mode("a", 0o600)) == b""


def test_a_long_file_with_every_line_changed_is_compared_quickly() -> None:
    old, new = b"x\r\n" * 20_000, b"x\n" * 20_000
    patch = diff(files({"f": old}), files({"f": new}))
    assert made_by(TOOLS[0], {"f": old}, patch) == {"f": new}
