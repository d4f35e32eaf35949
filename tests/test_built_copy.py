"""A student who edits the copy of the build is told so."""

from __future__ import annotations

import os
import zipfile
from pathlib import Path

import pytest

from grader.verdict.checks import package, source
from tests.static_bench import NAME, NODE, Bench, mistake

BUILD = f"build/{NAME}/build/lib/{NODE}"
INSTALL = f"install/{NAME}/lib/python3.12/site-packages/{NODE}"
CODE = "#!/usr/bin/env python3\n\n\ndef main(args=None):\n    print('changed')\n"


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    """Return a package in a workspace that was built; the bench's root is the workspace."""
    bench = Bench(tmp_path / "ws/src" / NAME)
    bench.root = tmp_path / "ws"
    for folder in ("build", "install", "log"):
        bench.write(f"{folder}/COLCON_IGNORE", "")
    set_time(bench.root / "src" / NAME / NODE, 1_000_000)
    return bench


def set_time(path: Path, seconds: int) -> None:
    os.utime(path, (seconds, seconds))


def add_copy(bench: Bench, path: str, seconds: int) -> None:
    bench.write(path, CODE)
    set_time(bench.root / path, seconds)


def advice(bench: Bench) -> str:
    return "\n".join(bench.passes(package.found).advice)


@pytest.mark.parametrize("copy", [BUILD, INSTALL])
def test_the_copy_of_an_empty_file_is_named(bench: Bench, copy: str) -> None:
    add_copy(bench, copy, 1)
    bench.write(f"src/{NAME}/{NODE}", "")
    failed = bench.fails(source.node_file)
    assert mistake(failed) == "source.empty_node_file"
    assert copy in failed.actual
    assert copy in failed.fix
    assert "Ctrl+S" not in failed.fix


def test_the_copy_of_a_missing_file_is_named(bench: Bench) -> None:
    add_copy(bench, BUILD, 1)
    (bench.root / "src" / NAME / NODE).unlink()
    failed = bench.fails(source.node_file)
    assert mistake(failed) == "source.no_node_file"
    assert BUILD in failed.fix


def test_a_node_that_was_written_in_the_build_folder_is_named(bench: Bench) -> None:
    there = f"build/{NAME}/my_first_node.py"
    add_copy(bench, there, 1)
    (bench.root / "src" / NAME / NODE).unlink()
    failed = bench.fails(source.node_file)
    assert mistake(failed) == "source.no_node_file"
    assert there in failed.fix


def test_a_newer_copy_is_advice(bench: Bench) -> None:
    add_copy(bench, BUILD, 1_000_100)
    assert BUILD in advice(bench)


def test_a_newer_copy_in_an_archive_is_advice(bench: Bench, tmp_path: Path) -> None:
    add_copy(bench, BUILD, 1_700_000_100)
    set_time(bench.root / "src" / NAME / NODE, 1_700_000_000)
    for path in bench.root.rglob("*"):
        if path.name not in ("my_first_node.py",):
            set_time(path, 1_700_000_000)
    with zipfile.ZipFile(tmp_path / "ws.zip", "w") as archive:
        for path in sorted(bench.root.rglob("*")):
            archive.write(path, path.relative_to(tmp_path))
    bench.root = tmp_path / "ws.zip"
    assert BUILD in advice(bench)


@pytest.mark.parametrize("seconds", [999_000, 1_000_000])
def test_a_copy_that_the_build_made_before_the_last_change_is_no_advice(
    bench: Bench, seconds: int
) -> None:
    add_copy(bench, BUILD, seconds)
    assert BUILD not in advice(bench)


def test_an_equal_copy_is_no_advice(bench: Bench) -> None:
    bench.write(BUILD, (bench.root / "src" / NAME / NODE).read_bytes())
    assert BUILD not in advice(bench)


def test_a_copy_behind_a_link_is_not_read(bench: Bench, tmp_path: Path) -> None:
    other = tmp_path / "other" / BUILD.removeprefix("build/")
    other.parent.mkdir(parents=True)
    other.write_text(CODE)
    (bench.root / "build" / NAME).symlink_to(tmp_path / "other" / NAME)
    bench.write(f"src/{NAME}/{NODE}", "")
    assert "build/" not in bench.fails(source.node_file).actual
