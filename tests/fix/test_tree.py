"""The edits that make a mutant: each does what its name says, or raises an error."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.package.edit.tree import (
    Chmod,
    Copy,
    Crlf,
    Delete,
    Edit,
    EditError,
    Link,
    Move,
    Nest,
    Replace,
    Tree,
    Write,
    apply_all,
    digest,
    read_tree,
    write_tree,
)
from grader.package.intake.model import SourceFile


def of(*files: tuple[str, bytes, int]) -> Tree:
    return {path: SourceFile(path, "file", mode, data) for path, data, mode in files}


TREE = of(
    ("a.py", b"#!x\none two\n", 0o755), ("in/b.txt", b"b\n", 0o644), ("in/c.txt", b"c\n", 0o644)
)


def files(folder: Path) -> dict[str, str]:
    return {
        path.relative_to(folder).as_posix(): path.read_bytes().decode()
        for path in folder.rglob("*")
        if path.is_file()
    }


def test_a_tree_is_written_and_read_back(tmp_path: Path) -> None:
    write_tree(TREE, tmp_path / "out")
    assert files(tmp_path / "out") == {
        "a.py": "#!x\none two\n",
        "in/b.txt": "b\n",
        "in/c.txt": "c\n",
    }
    assert (tmp_path / "out/a.py").stat().st_mode & 0o777 == 0o755
    assert read_tree(tmp_path / "out") == TREE


def test_scripts_are_executable_if_the_disk_keeps_no_modes(tmp_path: Path) -> None:
    (tmp_path / "node.py").write_text("#!/usr/bin/env python3\n")
    (tmp_path / "setup.py").write_text("pass\n")
    (tmp_path / "node.py").chmod(0o644)
    (tmp_path / "setup.py").chmod(0o755)
    assert {path: entry.mode for path, entry in read_tree(tmp_path).items()} == {
        "node.py": 0o755,
        "setup.py": 0o644,
    }


def test_each_edit_does_what_its_name_says() -> None:
    edits: tuple[Edit, ...] = (
        Replace("a.py", "two", "three"),
        Write("new/d.txt", b"d"),
        Delete("in/c.txt"),
        Copy("in", "out"),
        Move("in/b.txt", "b.txt"),
        Chmod("out/b.txt", 0o600),
        Crlf("b.txt"),
        Link("out/l", "/nowhere"),
        Nest("src/p"),
    )
    assert apply_all(edits, TREE) == {
        **of(
            ("src/p/a.py", b"#!x\none three\n", 0o755),
            ("src/p/new/d.txt", b"d", 0o644),
            ("src/p/out/b.txt", b"b\n", 0o600),
            ("src/p/b.txt", b"b\r\n", 0o644),
        ),
        "src/p/out/l": SourceFile("src/p/out/l", "link", 0o777, target="/nowhere"),
    }
    assert TREE["a.py"].data == b"#!x\none two\n"


def test_a_rewritten_file_keeps_its_mode() -> None:
    assert Write("a.py", b"x").apply(TREE)["a.py"].mode == 0o755
    assert Write("a.py", b"x", 0o640).apply(TREE)["a.py"].mode == 0o640


@pytest.mark.parametrize(
    "edit",
    [
        Replace("a.py", "three", ""),
        Replace("a.py", "o", ""),
        Replace("gone", "o", ""),
        Delete("gone"),
        Delete("i"),
        Copy("gone", "x"),
        Copy("a.py", "in"),
        Chmod("in", 0o600),
        Crlf("gone"),
    ],
)
def test_an_edit_that_does_not_fit_is_an_error(edit: Edit) -> None:
    with pytest.raises(EditError):
        apply_all((edit,), TREE)


def test_a_link_is_a_link_on_disk(tmp_path: Path) -> None:
    write_tree(apply_all((Link("a.py", "in/b.txt"),), TREE), tmp_path / "out")
    assert (tmp_path / "out/a.py").readlink() == Path("in/b.txt")


@pytest.mark.parametrize(
    "edit", [Chmod("a.py", 0o644), Link("a.py", "x"), Delete("a.py"), Write("a.py", b"y")]
)
def test_packages_that_differ_have_different_digests(edit: Edit) -> None:
    assert digest(apply_all((edit,), TREE)) != digest(TREE)
    assert digest(dict(reversed(list(TREE.items())))) == digest(TREE)
