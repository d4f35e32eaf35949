"""A checkout is the same on every machine: Git for Windows uses CRLF and makes no links."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from tests import processes

LIKE_WINDOWS = ("-c", "core.autocrlf=true", "-c", "core.eol=crlf", "-c", "core.symlinks=false")
LIKE_LINUX = ("-c", "core.autocrlf=false", "-c", "core.symlinks=true")


def git(*words: str | Path, cwd: Path) -> bytes:
    return subprocess.run(["git", *words], cwd=cwd, capture_output=True, check=True).stdout


@pytest.fixture(scope="module")
def windows_clone(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A clone of this repository, as Git for Windows makes it."""
    clone = tmp_path_factory.mktemp("windows") / "clone"
    git(*LIKE_WINDOWS, "clone", "--quiet", processes.ROOT, clone, cwd=processes.ROOT)
    return clone


def blobs(checkout: Path) -> dict[str, str]:
    """Return the Git object of every committed file by its path."""
    rows = git("ls-tree", "-r", "-z", "HEAD", cwd=checkout).decode().split("\0")
    return {row.partition("\t")[2]: row.split()[2] for row in rows if row}


def test_every_file_has_the_committed_bytes(windows_clone: Path) -> None:
    """Shell scripts, Dockerfiles and sources keep LF; files with intentional CRLF keep it."""
    committed = blobs(windows_clone)
    assert {"docker/Dockerfile", "docker/apt_install.sh", "lab/shell/bashrc"} <= committed.keys()
    listing = "\n".join(committed).encode()
    hashed = subprocess.run(
        ["git", "hash-object", "--no-filters", "--stdin-paths"],
        cwd=windows_clone,
        input=listing,
        capture_output=True,
        check=True,
    ).stdout
    found = dict(zip(committed, hashed.decode().split(), strict=True))
    assert {path for path, blob in committed.items() if found[path] != blob} == set()


@pytest.mark.parametrize("settings", [LIKE_WINDOWS, LIKE_LINUX], ids=["windows", "linux"])
def test_git_sees_no_change_in_it(settings: tuple[str, ...], windows_clone: Path) -> None:
    """Neither the Git that made it nor that of WSL or of a container on the same files."""
    git("read-tree", "HEAD", cwd=windows_clone)  # forgets which files are known to be unchanged
    assert git(*settings, "status", "--porcelain", cwd=windows_clone) == b""


def test_nothing_needs_a_link(windows_clone: Path) -> None:
    """Without links Git writes a text file with the target's name, so a program would not run."""
    modes = git("ls-files", "--stage", cwd=windows_clone).decode().splitlines()
    assert [row for row in modes if row.startswith("120000")] == []
