"""The chain of a ledger: any row that is changed, removed, inserted or exchanged is noticed."""

from __future__ import annotations

import re
import sqlite3
import zlib
from collections.abc import Callable
from datetime import datetime, timezone
from pathlib import Path

import pytest

from grader.base.errors import SurroundingsError
from grader.base.signing import PRIVATE_FILE, PublicKey, make_key, own_key, read_public_key
from grader.batch.ledger import HandedInRow, Ledger
from grader.batch.ledger_chain import START, ChainCheck
from grader.batch.ledger_rows import remove
from grader.batch.ledger_schema import FIRST
from grader.batch.model import Override, Student
from grader.batch.verify import verify_ledger
from tests import processes
from tests.batch.classes import corpus_class, replay_all
from tests.report.samples import check, report

AT = datetime(2026, 11, 20, 23, 59, tzinfo=timezone.utc)
HELLO = "hello_time"
SENT = "a" * 64
EARLIER = Path(__file__).parent / "ledgers" / "before_salts.sqlite"


@pytest.fixture
def key(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> PublicKey:
    """The key of an installation."""
    monkeypatch.setenv("GRADER_STATE", str(tmp_path / "state"))
    return make_key()


@pytest.fixture
def path(tmp_path: Path, key: PublicKey) -> Path:
    """A signed ledger with three verdicts and a correction."""
    place = tmp_path / "ledger.sqlite"
    with Ledger(place) as ledger:
        for student in ("ann", "bob", "kim"):
            ledger.record(student, "k1", report(check("run.output", "failed")), evidence=b"seen")
        ledger.override(HELLO, Override("kim", "run.output", 10, "seen", "lee", AT))
    return place


@pytest.fixture
def full(path: Path) -> Path:
    """The same with a row in every other table that the chain covers."""
    with Ledger(path) as ledger:
        ledger.enrol(HELLO, [Student("ann", "Ann A."), Student("kim", "Kim K.")])
        for late in (False, True):
            ledger.record_handed_in(HELLO, [HandedInRow("kim", SENT, AT, late, "kim.zip", AT)])
        ledger.request_regrades(row for row in ledger.verdicts().values() if row.student == "ann")
        ledger.record_fault("bob", "k2", "no Docker")
        ledger.note("begun", "{}")
    return path


def found(path: Path, key: PublicKey | None) -> ChainCheck:
    with Ledger(path) as ledger:
        return ledger.check_chain(key)


def change(path: Path, *statements: str) -> None:
    with sqlite3.connect(path) as connection:
        for statement in statements:
            connection.execute(statement)
    connection.close()


def test_an_untouched_ledger_is_unbroken_and_signed(path: Path, key: PublicKey) -> None:
    chain = found(path, key)
    assert chain.faults == []
    assert (chain.head.count, chain.signed) == (4, 4)
    assert len(chain.head.hash) == len(START)


BETTER = "X'" + zlib.compress(report().model_dump_json(by_alias=True).encode()).hex() + "'"


@pytest.mark.parametrize(
    "statement",
    [
        "UPDATE verdict SET score = 100 WHERE student = 'kim'",
        f"UPDATE verdict SET report = {BETTER} WHERE student = 'kim'",
        "UPDATE verdict SET evidence = NULL WHERE student = 'kim'",
        "UPDATE verdict SET student = CASE id WHEN 1 THEN 'bob' WHEN 2 THEN 'ann' ELSE student END, "
        "key = CASE id WHEN 1 THEN 'k0' ELSE key END",
        "UPDATE verdict SET marked = '2020-01-01T00:00:00+00:00' WHERE id = 2",
        "DELETE FROM verdict WHERE id = 1",
        "DELETE FROM verdict WHERE id = 3",
        "UPDATE override SET points = 3",
        "DELETE FROM override",
        "INSERT INTO override (student, assignment, check_id, points, because, by, at) "
        "VALUES ('bob', 'hello_time', '', 100, 'x', 'x', '2026-11-21T00:00:00+00:00')",
        "UPDATE link SET row = 9 WHERE id = 2",
        "UPDATE link SET hash = (SELECT hash FROM link WHERE id = 1) WHERE id = 2",
        "UPDATE link SET signature = (SELECT signature FROM link WHERE id = 1) WHERE id = 2",
        "UPDATE link SET signature = NULL WHERE id = 4",
        "DELETE FROM link WHERE id = 2",
        "DELETE FROM link WHERE id = 4",
    ],
)
def test_any_change_is_noticed(path: Path, key: PublicKey, statement: str) -> None:
    change(path, statement)
    assert found(path, key).faults


@pytest.mark.parametrize(
    "statement",
    [
        "UPDATE handed_in SET late = 0",
        "UPDATE handed_in SET first_seen = '2026-11-01T00:00:00+00:00'",
        "DELETE FROM handed_in",
        "INSERT INTO handed_in (student, assignment, submission, path, first_seen) "
        "VALUES ('bob', 'hello_time', 'x', 'x', '2026-11-21T00:00:00+00:00')",
        "DELETE FROM regrade",
        "UPDATE regrade SET before = 2",
        "INSERT INTO regrade (student, key, before, asked) VALUES ('kim', 'k1', 3, 'x')",
        "UPDATE fault SET message = ''",
        "DELETE FROM fault",
        "UPDATE setting SET value = '[]'",
        "INSERT INTO setting (name, value) VALUES ('corrections', '{}')",
        "UPDATE student SET name = CASE key WHEN 'ann' THEN 'Kim K.' ELSE 'Ann A.' END",
        "UPDATE link SET digest = '' WHERE place = 'fault'",
        "UPDATE link SET digest = NULL WHERE place = 'fault'",
        "UPDATE link SET salt = NULL WHERE place = 'setting'",
        "CREATE INDEX more ON fault (message)",
        "CREATE TABLE more (x)",
        "DROP INDEX verdict_by_submission",
        "ALTER TABLE setting ADD COLUMN more DEFAULT 'x'",
    ],
)
def test_any_change_of_the_other_rows_and_of_the_tables_is_noticed(
    full: Path, key: PublicKey, statement: str
) -> None:
    assert found(full, key).faults == []
    change(full, statement)
    assert found(full, key).faults


@pytest.mark.parametrize(
    "statement",
    [
        "CREATE TRIGGER more AFTER INSERT ON verdict BEGIN "
        "UPDATE verdict SET score = max_score WHERE student = 'kim'; END",
        "CREATE VIEW more AS SELECT * FROM verdict",
    ],
)
def test_a_planted_program_is_not_run_and_is_told(full: Path, statement: str) -> None:
    change(full, statement)
    before = full.read_bytes()
    with pytest.raises(SurroundingsError, match="which no grader made"):
        Ledger(full)
    assert full.read_bytes() == before
    status, text = said("verify", full)
    assert (status, "'more', which no grader made" in text) == (1, True), text


@pytest.mark.parametrize("wrong", ["'text'", "7", "1e999", "x'ff'", "CAST(x'ff' AS TEXT)"])
@pytest.mark.parametrize(
    "column",
    ["verdict.report", "verdict.evidence", "verdict.student", "verdict.score", "link.signature",
     "link.hash", "link.digest", "link.salt", "link.place", "link.row"],
)  # fmt: skip
def test_whatever_stands_in_a_column_is_a_fault_and_no_error(
    full: Path, key: PublicKey, column: str, wrong: str
) -> None:
    table, _, name = column.partition(".")
    change(full, f"UPDATE {table} SET {name} = {wrong} WHERE id = 2")
    assert found(full, key).faults
    findings = verify_ledger(full, key, "")
    assert all(text.isprintable() for _, text in findings.lines)


def test_what_changes_nothing_adds_no_link(full: Path, key: PublicKey) -> None:
    count = found(full, key).head.count
    with Ledger(full) as ledger:
        ledger.enrol(HELLO, [Student("ann", "Ann A."), Student("kim", "Kim K.")])
        later = datetime(2026, 12, 1, tzinfo=timezone.utc)
        ledger.record_handed_in(HELLO, [HandedInRow("kim", SENT, AT, True, "kim.zip", later)])
        ledger.request_regrades(ledger.verdicts()["ann", "k1"] for _ in range(2))
        ledger.note("begun", "{}")
    assert found(full, key).head.count == count


def test_the_chain_stays_whole_without_the_content_of_a_students_rows(
    full: Path, key: PublicKey
) -> None:
    own = own_key()
    with Ledger(full) as ledger, ledger._file.write() as connection:
        for table in ("regrade", "verdict", "override", "handed_in"):
            assert remove(connection, table, {"student": "ann"}, own) in (0, 1)
        assert remove(connection, "student", {"key": "ann"}, own) == 1
    chain = found(full, key)
    assert (chain.faults, chain.removed) == ([], 3)
    said_first = verify_ledger(full, key, "").lines[0][1]
    assert "2 verdicts, 1 correction, 4 other rows, 3 removed" in said_first
    with sqlite3.connect(full) as connection:
        query = "SELECT count(*) FROM link WHERE salt IS NOT NULL AND (place, row) IN "
        removed = "(SELECT place, row FROM link WHERE digest = '')"
        assert connection.execute(query + removed).fetchone() == (0,), "nothing to guess from"
    connection.close()
    change(full, "DELETE FROM verdict WHERE student = 'bob'")
    assert found(full, key).faults, "who has no key cannot remove anything"


def test_equal_rows_have_other_digests(tmp_path: Path, key: PublicKey) -> None:
    digests = set()
    for name in ("one", "two"):
        with Ledger(tmp_path / f"{name}.sqlite") as ledger:
            ledger.note("begun", "{}")
        with sqlite3.connect(tmp_path / f"{name}.sqlite") as connection:
            digests |= set(connection.execute("SELECT digest FROM link"))
        connection.close()
    assert len(digests) == 2


def test_a_ledger_from_before_the_salts_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It was written by that grader, and its links of verdicts and corrections stay as they are."""
    monkeypatch.setenv("GRADER_STATE", str(tmp_path / "state"))
    place = tmp_path / "ledger.sqlite"
    place.write_bytes(EARLIER.read_bytes())
    public = read_public_key(EARLIER.with_suffix(".pub.pem"))
    with sqlite3.connect(place) as connection:
        before = connection.execute("SELECT hash, signature FROM link ORDER BY id").fetchall()
    connection.close()
    with Ledger(place) as ledger:
        ledger.record("ann", "k1", report(), evidence=b"seen")
        assert ledger.count() == 3
        assert ledger.students(HELLO) == [Student("ann", "Ann A."), Student("kim", "Kim K.")]
        assert ledger.setting("begun") == "{}"
        assert ledger.fault("ann", "k2") == "no Docker"
    chain = found(place, None)
    assert (chain.faults, chain.signed) == ([], 3)
    with sqlite3.connect(place) as connection:
        after = connection.execute("SELECT hash, signature FROM link ORDER BY id").fetchall()
    connection.close()
    assert after[: len(before)] == before
    assert len(after) == len(before) + 6 + 2, "adopted: six rows; then a verdict, its regrade done"
    assert all("is not signed" in fault for fault in found(place, public).faults)
    for statement in (
        "UPDATE verdict SET score = 99 WHERE id = 1",
        "DELETE FROM verdict WHERE id = 2",
    ):
        change(place, statement)
        assert found(place, None).faults


def test_a_chain_made_anew_needs_the_key(
    path: Path, key: PublicKey, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("GRADER_STATE", str(tmp_path / "without"))
    change(path, "UPDATE verdict SET score = 100", "DROP TABLE link", "PRAGMA user_version = 1",
           "ALTER TABLE verdict DROP COLUMN evidence", "ALTER TABLE override DROP COLUMN verdict",
           "ALTER TABLE handed_in DROP COLUMN late_seconds",
           "ALTER TABLE handed_in DROP COLUMN extension")  # fmt: skip
    assert found(path, None).faults == [], "without a key it cannot be known"
    assert found(path, key).faults


def test_rows_missing_at_the_end_show_by_a_noted_head(path: Path, key: PublicKey) -> None:
    noted = found(path, key).head.hash
    change(path, "DELETE FROM override", "DELETE FROM link WHERE id = 4")
    chain = found(path, key)
    assert chain.faults == []
    assert noted not in chain.hashes


def test_a_ledger_from_before_the_chain_is_adopted(tmp_path: Path, key: PublicKey) -> None:
    place = tmp_path / "old.sqlite"
    connection = sqlite3.connect(place)
    connection.executescript(FIRST)
    content = zlib.compress(report().model_dump_json(by_alias=True).encode())
    for number, student in enumerate(("ann", "bob")):
        connection.execute(
            "INSERT INTO verdict (student, key, round, assignment, submission, distro, score, "
            "max_score, report, marked) VALUES (?, 'k', 1, 'hello_time', 's', 'jazzy', 100, 100, "
            "?, ?)",
            (student, content, f"2026-11-0{number + 1}T00:00:00+00:00"),
        )
    connection.execute("PRAGMA application_id = 0x524F5332")
    connection.execute("PRAGMA user_version = 1")
    connection.commit()
    connection.close()
    with Ledger(place) as ledger:
        assert ledger.count() == 2
        assert ledger.report(1) == report()
        assert ledger.evidence(1) == b""
    chain = found(place, key)
    assert (chain.faults, chain.head.count) == ([], 2)


def test_a_key_that_cannot_be_used_is_said_before_anything_is_marked(
    tmp_path: Path, key: PublicKey
) -> None:
    (tmp_path / "state" / PRIVATE_FILE).chmod(0o644)
    with pytest.raises(SurroundingsError, match="other users can read"):
        Ledger(tmp_path / "new.sqlite")
    assert not (tmp_path / "new.sqlite").exists()


def test_verdicts_before_there_was_a_key_stay_unsigned_and_are_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("GRADER_STATE", str(tmp_path / "state"))
    place = tmp_path / "ledger.sqlite"
    with Ledger(place) as ledger:
        ledger.record("ann", "k", report())
    make_key()
    with Ledger(place) as ledger:
        ledger.record("bob", "k", report())
    own = own_key()
    assert own is not None
    chain = found(place, own.public)
    assert chain.signed == 1
    assert [fault for fault in chain.faults if "is not signed" in fault] == chain.faults != []


def test_a_killed_writer_leaves_row_and_link_or_neither(
    path: Path, key: PublicKey, monkeypatch: pytest.MonkeyPatch
) -> None:
    from grader.batch import ledger_chain

    append: Callable[..., None] = ledger_chain.append

    def fails(*words: object) -> None:
        append(*words)
        raise KeyboardInterrupt

    monkeypatch.setattr(ledger_chain, "append", fails)
    with Ledger(path) as ledger, pytest.raises(KeyboardInterrupt):
        ledger.record("lee", "k1", report())
    monkeypatch.undo()
    monkeypatch.setenv("GRADER_STATE", str(path.parent / "state"))
    chain = found(path, key)
    assert (chain.faults, chain.head.count) == ([], 4)


@pytest.fixture
def marked(tmp_path: Path, key: PublicKey) -> Path:
    """The output folder of a class that was marked with a key."""
    folder = corpus_class(tmp_path / "class", ["solution", "spin_missing", "entry_missing"])
    done = replay_all(folder, tmp_path / "out", "-q")
    assert done.returncode == 1, done.stderr
    return tmp_path / "out"


def said(*words: str | Path) -> tuple[int, str]:
    done = processes.run(processes.grader(*words))
    assert "Traceback" not in done.stderr, done.stderr
    return done.returncode, done.stdout + done.stderr


def test_the_ledger_of_a_class_has_the_evidence_of_every_verdict(marked: Path) -> None:
    status, text = said("verify", marked / "ledger.sqlite")
    assert status == 0, text
    assert "3 of 3 verdicts agree with theirs" in text
    assert re.search(r"signatures +(\d+) of \1, checked with SHA256:", text), text
    (report,) = marked.glob("*spin_missing*/jazzy/report.json")
    for command in ("replay", "verify"):
        status, text = said(command, report)
        assert status == 0, text
    assert said("replay", report)[1].startswith("the same verdict: 60 of 100")


def test_a_correction_is_part_of_the_chain_and_a_changed_score_is_noticed(marked: Path) -> None:
    ledger = marked / "ledger.sqlite"
    words = ("s1-spin_missing", "--check", "run.spins", "--points", "5", "--because", "seen")
    status, text = said("override", *words, "--ledger", ledger)
    assert status == 0, text
    status, text = said("verify", ledger)
    assert (status, "3 verdicts, 1 correction" in text) == (0, True), text
    head = next(line.split()[-1] for line in text.splitlines() if line.startswith("head"))
    assert said("verify", ledger, "--head", head)[0] == 0
    assert said("verify", ledger, "--head", "0" * 63 + "1")[0] == 1
    change(ledger, "UPDATE override SET points = 10")
    status, text = said("verify", ledger)
    assert (status, "override 1 of" in text) == (1, True), text


def test_a_changed_report_of_a_class_is_not_found_in_its_ledger(marked: Path) -> None:
    (report,) = marked.glob("*spin_missing*/jazzy/report.json")
    report.write_text(report.read_text().replace('"score": 60', '"score": 100', 1))
    status, text = said("verify", report)
    assert (status, "has no verdict with this report" in text) == (2, True), text
