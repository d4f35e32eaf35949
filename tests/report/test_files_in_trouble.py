"""Reports on disk in case of kills, a full disk, missing permissions and planted links."""

from __future__ import annotations

import errno
import hashlib
import itertools
import json
import os
import random
import resource
import signal
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from grader.base.errors import SurroundingsError
from grader.base.i18n.message import Message
from grader.report.files import report_json, write_matrix, write_report
from grader.report.model import Report
from tests.report.samples import report, report_at

KILLS = 60
PADDING = 300_000  # characters, so that a write takes more than one block


def suffix(path: str | Path) -> str:
    """Return the eight hex digits that distinguish two submissions with the same name."""
    return hashlib.sha256(str(path).encode()).hexdigest()[:8]


@pytest.fixture
def ordinary_user(tmp_path: Path) -> Iterator[None]:
    """Become an ordinary user during the test, because root can write anywhere."""
    if os.geteuid() == 0:
        os.seteuid(65534)
        yield
        os.seteuid(0)
    else:
        yield


def test_a_planted_link_for_the_students_folder_is_not_followed(tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    out = tmp_path / "out"
    out.mkdir()
    (out / "anna").symlink_to(tmp_path / "elsewhere")
    written = write_report(report_at("/s/anna"), out, "anna")
    assert written.parent.parent.name == f"anna-{suffix('/s/anna')}"
    assert list((tmp_path / "elsewhere").iterdir()) == []


def test_a_planted_link_for_the_distros_folder_is_reported(tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "out" / "anna").mkdir(parents=True)
    (tmp_path / "out" / "anna" / "jazzy").symlink_to(tmp_path / "elsewhere")
    with pytest.raises(SurroundingsError, match="link or file is in the place of a folder"):
        write_report(report_at("/s/anna"), tmp_path / "out", "anna")
    assert list((tmp_path / "elsewhere").iterdir()) == []


@pytest.mark.parametrize("target", ["file", "nowhere", "fifo"])
def test_a_planted_report_is_neither_followed_nor_waited_for(tmp_path: Path, target: str) -> None:
    victim = tmp_path / "victim"
    place = tmp_path / "out" / "anna" / "jazzy"
    place.mkdir(parents=True)
    if target == "file":
        victim.write_text(report_json(report_at("/s/anna")))
    if target == "fifo":
        os.mkfifo(place / "report.json")
    else:
        (place / "report.json").symlink_to(victim)
    before = victim.read_text() if target == "file" else None
    written = write_report(report_at("/s/anna", message="new"), tmp_path / "out", "anna")
    assert written.is_file()
    assert not written.is_symlink()
    assert written.parent.parent.name == f"anna-{suffix('/s/anna')}"  # owner unknown
    assert victim.exists() == (target == "file")
    assert before is None or victim.read_text() == before


def test_a_link_in_place_of_the_matrix_is_replaced_and_not_followed(tmp_path: Path) -> None:
    victim = tmp_path / "victim"
    victim.write_text("mine")
    write_report(report_at("/s/anna"), tmp_path / "out", "anna")
    (tmp_path / "out" / "anna" / "matrix.json").symlink_to(victim)
    written = write_matrix([report_at("/s/anna")], tmp_path / "out", "anna")
    assert not written.is_symlink()
    assert victim.read_text() == "mine"


def write_until_killed(out: Path, marked: list[Report]) -> int:
    """Start a process that writes the reports in turn; return its id after the first round."""
    reader, writer = os.pipe()
    pid = os.fork()
    if pid == 0:
        try:
            for number in itertools.count():
                write_report(marked[number % len(marked)], out, "anna")
                if number == len(marked):
                    os.write(writer, b".")
        finally:
            os._exit(1)
    os.close(writer)
    assert os.read(reader, 1) == b"."
    os.close(reader)
    return pid


def test_after_a_kill_the_old_or_the_new_report_is_complete(tmp_path: Path) -> None:
    whole = {letter * PADDING for letter in "AB"}
    marked = [report(evidence={"build_log": log, "transcript": ""}) for log in sorted(whole)]
    chance = random.Random(17)
    file = tmp_path / "anna" / "jazzy" / "report.json"
    most_left_over = 0
    for _ in range(KILLS):
        pid = write_until_killed(tmp_path, marked)
        time.sleep(chance.uniform(0, 0.02))  # kill at a random moment
        os.kill(pid, signal.SIGKILL)
        _, status = os.waitpid(pid, 0)
        assert os.WTERMSIG(status) == signal.SIGKILL
        assert json.loads(file.read_text())["evidence"]["build_log"] in whole
        most_left_over = max(most_left_over, len(list(file.parent.iterdir())) - 1)
    assert most_left_over == 1  # left by a kill, removed by the next process
    write_report(report(), tmp_path, "anna")
    assert [path.name for path in file.parent.iterdir()] == ["report.json"]


def test_an_unwritable_folder_is_reported_with_a_fix(tmp_path: Path, ordinary_user: None) -> None:
    for out in (Path("/proc/reports"), Path("/usr/reports")):
        with pytest.raises(SurroundingsError, match=f"below {out}") as text:
            write_report(report(), out, "anna")
        assert "--out" in text.value.remedy
        assert text.value.exit_status == 3
        assert isinstance(text.value.message, Message)
        assert isinstance(text.value.remedy, Message)


def test_a_file_in_place_of_the_folder_is_reported(tmp_path: Path) -> None:
    (tmp_path / "reports").write_text("mine")
    with pytest.raises(SurroundingsError, match="link or file is in the place of a folder"):
        write_report(report(), tmp_path / "reports", "anna")
    assert (tmp_path / "reports").read_text() == "mine"


def test_on_a_full_disk_the_old_report_stays_and_nothing_else_is_left(tmp_path: Path) -> None:
    written = write_report(report(message="old"), tmp_path, "anna")
    size, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    former = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    try:
        resource.setrlimit(resource.RLIMIT_FSIZE, (4096, hard))  # limits the size of a file
        with pytest.raises(SurroundingsError, match="Free some space") as text:
            write_report(report(message="new" * 9_000), tmp_path, "anna")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
        signal.signal(signal.SIGXFSZ, former)
    assert "--out" in str(text.value)
    assert json.loads(written.read_text())["message"] == "old"
    assert [path.name for path in written.parent.iterdir()] == ["report.json"]


@pytest.mark.parametrize("code", [errno.ENOSPC, errno.EDQUOT])
def test_a_disk_that_is_full_at_fsync_is_reported(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, code: int
) -> None:
    def full(fd: int) -> None:
        raise OSError(code, os.strerror(code))

    written = write_report(report(message="old"), tmp_path, "anna")
    monkeypatch.setattr("os.fsync", full)
    with pytest.raises(SurroundingsError, match=r"disk \(or a quota\) is full"):
        write_report(report(message="new"), tmp_path, "anna")
    assert json.loads(written.read_text())["message"] == "old"
    assert [path.name for path in written.parent.iterdir()] == ["report.json"]
