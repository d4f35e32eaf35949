"""Locks between processes, and files and folders that are opened without following links."""

from __future__ import annotations

import errno
import os
import stat
import subprocess
import sys
from pathlib import Path

import pytest

from grader.base.lock import HeldError, lock_open, locked, take_lock
from grader.base.safe_open import NotRegularError, create_file, open_file, open_folder
from tests.processes import ROOT

HOLDER = (
    "import sys\nfrom pathlib import Path\nfrom grader.base.lock import take_lock\n"
    "take_lock(Path(sys.argv[1]))\nprint('held', flush=True)\nsys.stdin.read()\n"
)


def held_elsewhere(path: Path) -> subprocess.Popen[str]:
    """Return a process that holds the lock until its standard input is closed."""
    process = subprocess.Popen(
        [sys.executable, "-c", HOLDER, path],
        cwd=ROOT,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    assert process.stdout.readline() == "held\n"
    return process


def test_a_lock_that_another_process_holds_is_refused_or_waited_for(tmp_path: Path) -> None:
    path = tmp_path / "lock"
    with held_elsewhere(path) as holder:
        with pytest.raises(HeldError):
            take_lock(path, waits=False)
        assert holder.stdin is not None
        with locked(path, waiting=holder.stdin.close):
            assert holder.stdin.closed
            with pytest.raises(HeldError):
                take_lock(path, waits=False)
    os.close(take_lock(path, waits=False))


def test_the_lock_of_a_killed_process_is_free(tmp_path: Path) -> None:
    path = tmp_path / "lock"
    with held_elsewhere(path) as holder:
        holder.kill()
        holder.wait()
        os.close(take_lock(path, waits=False))


def test_a_lock_nobody_holds_is_taken_without_a_word(tmp_path: Path) -> None:
    with locked(tmp_path / "lock", waiting=lambda: pytest.fail("nobody holds it")):
        pass
    assert stat.S_IMODE((tmp_path / "lock").stat().st_mode) == 0o600


def test_an_open_folder_can_be_locked(tmp_path: Path) -> None:
    first, second = open_folder(tmp_path), open_folder(tmp_path)
    try:
        lock_open(first)
        with pytest.raises(HeldError):
            lock_open(second, waits=False)
    finally:
        os.close(first)
        os.close(second)


def test_a_lock_file_is_never_a_link(tmp_path: Path) -> None:
    (tmp_path / "goal").write_text("kept")
    (tmp_path / "lock").symlink_to("goal")
    with pytest.raises(OSError) as caught:
        take_lock(tmp_path / "lock")
    assert caught.value.errno == errno.ELOOP


def test_links_are_not_followed(tmp_path: Path) -> None:
    (tmp_path / "folder").mkdir()
    (tmp_path / "file").write_bytes(b"text")
    (tmp_path / "to_folder").symlink_to("folder")
    (tmp_path / "to_file").symlink_to("file")
    (tmp_path / "to_nothing").symlink_to("gone")
    top = open_folder(tmp_path)
    try:
        for place, inside in ((tmp_path, None), (Path(), top)):
            with open_file(place / "file", inside=inside) as file:
                assert file.read() == b"text"
            os.close(open_folder(place / "folder", inside=inside))
            with pytest.raises(OSError, match="symbolic links"):
                open_file(place / "to_file", inside=inside)
            with pytest.raises(OSError, match=r"Not a directory|symbolic links"):
                open_folder(place / "to_folder", inside=inside)
            with pytest.raises(FileExistsError):
                create_file(place / "to_nothing", 0o600, inside=inside)
        os.close(open_folder(tmp_path / "to_folder", follows=True))
    finally:
        os.close(top)
    assert not (tmp_path / "gone").exists()


def test_only_regular_files_are_read_and_a_pipe_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    for path in (tmp_path, tmp_path / "pipe", Path("/dev/null")):
        with pytest.raises(NotRegularError, match="it is not a regular file"):
            open_file(path)


def test_a_new_file_has_its_mode_and_never_replaces_another(tmp_path: Path) -> None:
    with create_file(tmp_path / "new", 0o600) as file:
        file.write(b"mine")
    assert stat.S_IMODE((tmp_path / "new").stat().st_mode) == 0o600
    with pytest.raises(FileExistsError):
        create_file(tmp_path / "new", 0o600)
    assert (tmp_path / "new").read_bytes() == b"mine"
