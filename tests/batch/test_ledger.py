"""The ledger: records are durable and never changed, and other programs' files are untouched."""

from __future__ import annotations

import os
import signal
import sqlite3
import subprocess
import sys
from collections.abc import Iterator
from datetime import datetime, timezone
from pathlib import Path

import pytest

from grader.base.errors import GraderError, SurroundingsError, UsageError
from grader.batch.ledger import AlreadyMarkedError, HandedInRow, Ledger
from grader.batch.ledger_schema import STEPS
from grader.batch.model import Override, Student
from grader.report.model import Report
from tests.processes import ROOT
from tests.report.samples import check, report

AT = datetime(2026, 11, 20, 23, 59, tzinfo=timezone.utc)
HELLO = "hello_time"


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "ledger.sqlite"


@pytest.fixture
def ledger(path: Path) -> Iterator[Ledger]:
    with Ledger(path) as opened:
        yield opened


def worse() -> Report:
    return report(check("run.output", "failed"))


def test_a_verdict_is_read_back_as_recorded(ledger: Ledger) -> None:
    recorded = worse()
    row = ledger.record("kim", "k1", recorded)
    assert ledger.report(row) == recorded
    assert ledger.verdicts()["kim", "k1"].score == recorded.score


def test_a_verdict_of_several_students_is_recorded_for_all_or_none(ledger: Ledger) -> None:
    ledger.record("kim", "k1", report())
    ledger.record_for_all("k1", {"ann": worse(), "kim": worse(), "bob": worse()})
    found = {student: row.score for (student, _), row in ledger.verdicts().items()}
    assert found == {"kim": 100, "ann": 90, "bob": 90}, "who has one keeps it"
    with pytest.raises(UnicodeEncodeError):  # SQLite cannot store this key
        ledger.record_for_all("k2", {"ann": worse(), "b\ud800b": worse()})
    assert {key for _, key in ledger.verdicts()} == {"k1"}


def test_a_recorded_verdict_is_on_disk(path: Path) -> None:
    """Another process is killed right after it has printed "done", without closing anything."""
    code = (
        "import os, sys; from pathlib import Path; from grader.batch.ledger import Ledger;"
        "from tests.report.samples import report;"
        "ledger = Ledger(Path(sys.argv[1])); ledger.record('kim', 'k1', report());"
        "print('done', flush=True); sys.stdin.read()"
    )
    with subprocess.Popen(
        [sys.executable, "-c", code, str(path)],
        cwd=ROOT,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == b"done\n"
        process.send_signal(signal.SIGKILL)
    with Ledger(path) as ledger:
        assert ("kim", "k1") in ledger.verdicts()


def test_the_same_submission_is_not_marked_twice(ledger: Ledger) -> None:
    ledger.record("kim", "k1", report())
    with pytest.raises(AlreadyMarkedError):
        ledger.record("kim", "k1", worse())
    assert ledger.verdicts()["kim", "k1"].score == report().score
    ledger.record("lee", "k1", worse())  # the same content from another student
    ledger.record("kim", "k2", worse())  # other content
    assert ledger.count() == 3


def test_a_regrade_is_done_once(ledger: Ledger) -> None:
    first = ledger.record("kim", "k1", report())
    ledger.request_regrades(ledger.verdicts().values())
    ledger.request_regrades(ledger.verdicts().values())
    assert [again.before for again in ledger.pending_regrades().values()] == [first]
    second = ledger.record("kim", "k1", worse())
    assert not ledger.pending_regrades()
    assert ledger.verdicts()["kim", "k1"].id == second
    assert ledger.report(first) == report(), "history is kept"
    with pytest.raises(AlreadyMarkedError):
        ledger.record("kim", "k1", report())


def test_a_grader_fault_keeps_the_earlier_verdict_and_the_pending_regrade(
    ledger: Ledger,
) -> None:
    first = ledger.record("kim", "k1", report())
    ledger.request_regrades(ledger.verdicts().values())
    ledger.record_fault("kim", "k1", "the disk was full")
    assert ledger.verdicts()["kim", "k1"].id == first
    assert ledger.fault("kim", "k1") == "the disk was full"
    assert ledger.pending_regrades()
    ledger.record("kim", "k1", report())
    assert ledger.fault("kim", "k1") == "", "what went well at last is no fault any more"


def test_a_submission_keeps_the_time_at_which_it_was_first_seen(ledger: Ledger) -> None:
    later = AT.replace(year=2027)
    ledger.record_handed_in(HELLO, [HandedInRow("kim", "s1", AT, None, "/a", AT)])
    ledger.record_handed_in(HELLO, [HandedInRow("kim", "s1", later, True, "/b", later)])
    assert ledger.handed_in(HELLO) == [HandedInRow("kim", "s1", later, True, "/b", AT)]
    assert ledger.handed_in("another") == []


def test_the_newest_correction_of_a_check_applies_until_it_is_withdrawn(ledger: Ledger) -> None:
    first = Override("kim", "run.output", 4, "half of it", "curie", AT)
    total = Override("kim", "", 90, "agreed", "curie", AT)
    better = Override("kim", "run.output", 8, "most of it", "curie", AT)
    for override in (first, total, better):
        ledger.override(HELLO, override)
    assert ledger.overrides(HELLO) == [total, better]
    ledger.drop_override(HELLO, better)
    assert ledger.overrides(HELLO) == [total]
    assert ledger.overrides("another") == []


def test_the_members_of_the_class_are_recorded(ledger: Ledger) -> None:
    kim = Student("17", "Kim, Minji", "kim@example.org", "kim", "2026001", "A")
    ledger.enrol(HELLO, [kim])
    ledger.enrol(HELLO, [kim])
    assert ledger.students(HELLO) == [kim]


def test_the_ledger_is_readable_by_its_owner_only(path: Path, ledger: Ledger) -> None:
    ledger.record("kim", "k1", report())
    found = {file.name: file.stat().st_mode & 0o777 for file in path.parent.iterdir()}
    assert set(found.values()) == {0o600}, found


def test_a_second_grader_on_the_ledger_is_refused(path: Path, ledger: Ledger) -> None:
    with pytest.raises(UsageError, match="another grader"):
        Ledger(path)
    ledger.record("kim", "k1", report())  # the first one goes on


def test_a_missing_ledger_is_created_only_on_request(path: Path) -> None:
    with pytest.raises(UsageError, match="no ledger"):
        Ledger(path, makes=False)
    assert not list(path.parent.iterdir())


def _database(path: Path, *statements: str) -> None:
    connection = sqlite3.connect(path)
    for statement in statements:
        connection.execute(statement)
    connection.commit()
    connection.close()


@pytest.mark.parametrize(
    ("content", "error"),
    [
        (b"this is no database, it is somebody's letter" * 100, SurroundingsError),
        (b"SQLite format 3\0" + os.urandom(8_000), SurroundingsError),
    ],
)
def test_a_file_that_is_not_a_ledger_is_refused_and_kept(
    path: Path, content: bytes, error: type[GraderError]
) -> None:
    path.write_bytes(content)
    with pytest.raises(error, match="cannot be used"):
        Ledger(path)
    assert path.read_bytes() == content


def test_the_database_of_another_program_is_refused_and_kept(path: Path) -> None:
    _database(path, "CREATE TABLE addresses (name TEXT)", "INSERT INTO addresses VALUES ('Kim')")
    with pytest.raises(SurroundingsError, match="another program"):
        Ledger(path)
    rows = sqlite3.connect(path).execute("SELECT name FROM addresses").fetchall()
    assert rows == [("Kim",)]


def test_the_ledger_of_a_newer_grader_is_refused_and_kept(path: Path) -> None:
    with Ledger(path) as ledger:
        row = ledger.record("kim", "k1", report())
    _database(path, "PRAGMA user_version = 1000")
    with pytest.raises(UsageError, match="newer grader"):
        Ledger(path)
    _database(path, f"PRAGMA user_version = {len(STEPS)}")
    with Ledger(path) as ledger:
        assert ledger.report(row) == report()


def test_an_unreadable_folder_is_reported_with_a_fix(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(SurroundingsError, match="cannot be opened") as caught:
        Ledger(tmp_path / "file" / "ledger.sqlite")
    assert "--ledger" in caught.value.remedy


def test_a_damaged_report_is_reported_by_its_number(path: Path) -> None:
    with Ledger(path) as ledger:
        row = ledger.record("kim", "k1", report())
    _database(path, "UPDATE verdict SET report = x'00'")
    with Ledger(path) as ledger, pytest.raises(SurroundingsError, match=f"verdict {row}"):
        ledger.report(row)
