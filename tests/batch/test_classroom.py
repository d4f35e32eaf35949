"""Clones of GitHub Classroom: who, and when the last commit was made, without running git."""

from __future__ import annotations

import zlib
from datetime import datetime
from datetime import timedelta
from datetime import timezone
from pathlib import Path

import pytest

from grader.batch.discover import discover
from grader.batch.model import ClassFolder
from grader.batch.systems.git_commit import NoCommitError
from grader.batch.systems.git_commit import commit_time

from .handed_out import git
from .handed_out import package
from .handed_out import repository
from .handed_out import write

AT = datetime(2026, 3, 4, 9, 20, 30, tzinfo=timezone.utc)


def found_in(path: Path) -> ClassFolder:
    return discover(path, unpack=path.parent / "work")


def test_clones_are_known_by_what_follows_the_assignments_name(tmp_path: Path) -> None:
    root = tmp_path / "hw"
    for user, hour in (("ann-lee", 0), ("joe", 5)):
        at = (AT + timedelta(hours=hour)).isoformat()
        repository(root / f"hello-time-{user}", at=at)
    write(root / "mail-max", package())
    found = found_in(root)
    assert found.system == "github_classroom"
    ann, joe, max_ = found.handed_in
    assert (ann.student.key, ann.student.username) == ("hello-time-ann-lee", "ann-lee")
    assert (ann.submitted, joe.submitted) == (AT, AT + timedelta(hours=5))
    assert max_.submitted is None
    assert "last commit" in "\n".join(found.notes)


def test_one_clone_is_known_by_the_folder_that_gh_makes(tmp_path: Path) -> None:
    repository(tmp_path / "hw1-submissions" / "hw1-ann")
    (ann,) = found_in(tmp_path / "hw1-submissions").handed_in
    assert ann.student.username == "ann"


def test_a_commit_is_found_wherever_git_put_it(tmp_path: Path) -> None:
    made = repository(tmp_path / "a", at=AT.isoformat())
    assert commit_time(made) == AT
    git(made, "pack-refs", "--all")
    assert not (made / ".git/refs/heads/main").exists()
    assert commit_time(made) == AT
    git(made, "gc", "-q", "--prune=now")
    assert not list((made / ".git/objects").glob("??"))
    assert commit_time(made) == AT
    git(made, "checkout", "-q", "--detach")
    assert commit_time(made) == AT
    git(tmp_path, "clone", "-q", "--depth", "1", f"file://{made}", "b")
    assert commit_time(tmp_path / "b") == AT


def test_a_commit_that_is_packed_as_a_delta_is_found(tmp_path: Path) -> None:
    """Long messages that differ little make git store commits as deltas of each other."""
    made = repository(tmp_path / "a", at=AT.isoformat())
    message = "\n".join(f"line {n} of a long story that is told again and again" for n in range(99))
    for n in range(6):
        at = (AT + timedelta(days=n)).isoformat()
        git(made, "commit", "-q", "--allow-empty", "-m", f"{message} {n}", at=at)
    git(made, "repack", "-q", "-a", "-d", "-f", "--depth=50", "--window=50")
    index = next((made / ".git/objects/pack").glob("*.idx"))
    lines = git(made, "verify-pack", "-v", str(index)).splitlines()
    deltas = [line.split()[0] for line in lines if " commit " in line and len(line.split()) == 7]
    assert deltas
    for sha in deltas:
        git(made, "checkout", "-q", sha)
        seconds = int(git(made, "log", "-1", "--format=%ct"))
        assert commit_time(made) == datetime.fromtimestamp(seconds, timezone.utc)


def test_a_repository_of_sha256_is_read_too(tmp_path: Path) -> None:
    write(tmp_path / "a", package())
    git(tmp_path / "a", "init", "-q", "--object-format=sha256")
    git(tmp_path / "a", "add", "-A")
    git(tmp_path / "a", "commit", "-q", "-m", "x", at=AT.isoformat())
    assert commit_time(tmp_path / "a") == AT
    git(tmp_path / "a", "gc", "-q", "--prune=now")
    assert commit_time(tmp_path / "a") == AT


def test_nothing_that_a_repository_names_is_run(tmp_path: Path) -> None:
    """A fsmonitor, hooks, an alias and a pager that would leave a mark."""
    trap = tmp_path / "trap.sh"
    trap.write_text(f"#!/bin/sh\ntouch {tmp_path}/sprung\n")
    trap.chmod(0o755)
    for user in ("ann", "eve"):
        made = repository(tmp_path / "hw" / f"hw-{user}", at=AT.isoformat())
        with (made / ".git/config").open("a") as config:
            config.write(
                f"[core]\n\tfsmonitor = {trap}\n\tpager = {trap}\n\thooksPath = {tmp_path}\n"
            )
            config.write(f"[alias]\n\tlog = !{trap}\n[diff]\n\texternal = {trap}\n")
    found = found_in(tmp_path / "hw")
    assert [given.submitted for given in found.handed_in] == [AT, AT]
    assert not (tmp_path / "sprung").exists()


def broken_head(git_folder: Path) -> None:
    (git_folder / "HEAD").write_text("ref: refs/../../../../etc/passwd\n")


def no_commit(git_folder: Path) -> None:
    (git_folder / "refs/heads/main").unlink()


def round_in_circles(git_folder: Path) -> None:
    (git_folder / "refs/heads/main").write_text("ref: refs/heads/main\n")


def noise_for_an_object(git_folder: Path) -> None:
    for path in git_folder.glob("objects/??/*"):
        path.chmod(0o644)
        path.write_bytes(b"noise")


def a_bomb_for_an_object(git_folder: Path) -> None:
    for path in git_folder.glob("objects/??/*"):
        path.chmod(0o644)
        path.write_bytes(zlib.compress(b"commit 9\0" + bytes(3_000_000)))


def objects_elsewhere(git_folder: Path) -> None:
    elsewhere = git_folder.parent.parent.parent / "objects"
    (git_folder / "objects").rename(elsewhere)
    (git_folder / "objects").symlink_to(elsewhere)


@pytest.mark.parametrize(
    "break_it",
    [
        broken_head,
        no_commit,
        round_in_circles,
        noise_for_an_object,
        a_bomb_for_an_object,
        objects_elsewhere,
    ],
)
def test_a_broken_repository_has_no_time_and_is_marked_all_the_same(
    tmp_path: Path, break_it: object
) -> None:
    for user in ("ann", "joe"):
        repository(tmp_path / "hw" / f"hw-{user}", at=AT.isoformat())
    assert callable(break_it)
    break_it(tmp_path / "hw/hw-ann/.git")
    ann, joe = found_in(tmp_path / "hw").handed_in
    assert (ann.submitted, ann.problem) == (None, "")
    assert "no time of submission" in ann.notes[0]
    assert joe.submitted == AT


def test_a_pack_that_is_noise_is_damaged(tmp_path: Path) -> None:
    made = repository(tmp_path / "a")
    git(made, "gc", "-q", "--prune=now")
    (pack,) = (made / ".git/objects/pack").glob("*.pack")
    pack.chmod(0o644)
    content = pack.read_bytes()
    for noise in (bytes(len(content)), b"\xff" * len(content), content[:40], b""):
        pack.write_bytes(noise)
        with pytest.raises(NoCommitError):
            commit_time(made)
    (index,) = (made / ".git/objects/pack").glob("*.idx")
    index.chmod(0o644)
    index.write_bytes(index.read_bytes()[:100])
    with pytest.raises(NoCommitError):
        commit_time(made)
