"""A correction belongs to the verdict that it corrects, and to no later one."""

from __future__ import annotations

import sqlite3
import subprocess
import zlib
from datetime import datetime, timedelta, timezone
from pathlib import Path

import pytest

from grader.base.errors import UsageError
from grader.batch import ledger_schema
from grader.batch.correction import counting_verdict, holds
from grader.batch.ledger import HandedInRow, Ledger
from grader.batch.model import UNKNOWN, Override
from grader.report.model import Report
from tests.batch.archives import write
from tests.batch.downloads import scored
from tests.batch.stub_run import Run, grade_all
from tests.processes import grader, run
from tests.report.samples import check, report

HELLO = "hello_time"
NAMES = ("Ann Lee", "Bela Nagy")
LAPSED = "Corrections that no longer apply"


def override(marked: Run, *words: str) -> subprocess.CompletedProcess[str]:
    return run(grader("override", *words, "--out", marked.out))


def lapsed(marked: Run) -> str:
    """Return what the terminal lists for the instructor to repeat, without its line ends."""
    return " ".join(marked.output.partition(LAPSED)[2].split())


@pytest.mark.prefix
@pytest.mark.full
def test_a_new_attempt_is_not_corrected_by_the_correction_of_the_last_one(tmp_path: Path) -> None:
    folder, out = tmp_path / "class", tmp_path / "out"
    for name in NAMES:
        write(folder / name, scored(60))
    grade_all(folder, out)
    total = ("--points", "10", "--because", "copied")
    one = ("--check", "run.output", "--points", "5", "--because", "half of it")
    assert override(Run(0, "", out), "Ann Lee", *total).returncode == 0
    assert override(Run(0, "", out), "Bela Nagy", *one, "--force").returncode == 0
    first = grade_all(folder, out, quiet=False)
    assert first.finals() == {"Ann Lee": "10", "Bela Nagy": "5"}
    assert LAPSED not in first.output
    assert grade_all(folder, out, "--regrade").finals() == first.finals(), "the same files"

    for name in NAMES:
        write(folder / name, scored(100))
    second = grade_all(folder, out, quiet=False)
    assert second.finals() == {"Ann Lee": "100", "Bela Nagy": "100"}
    assert "Ann Lee: the total of attempt 1 was corrected to 10, because: copied" in lapsed(second)
    what = "run.output of attempt 1 was corrected to 5, because: half of it"
    assert f"Bela Nagy: {what}" in lapsed(second)
    page = (out / "index.html").read_text(encoding="utf-8")
    assert page.index(LAPSED) < page.index("The class in numbers")
    assert what in page
    assert what in second.column("gradebook.csv", "notes", "name")["Bela Nagy"]
    pages = [page.read_text(encoding="utf-8") for page in (out / "feedback").glob("*.md")]
    assert len(pages) == 2
    assert not any("corrected" in page.casefold() for page in pages)
    assert override(second, "--list").stdout.count("no longer applies") == 2

    # repeated for the attempt that counts, undone for the other one
    assert override(second, "Ann Lee", "--points", "20", "--because", "copied").returncode == 0
    done = override(second, "Bela Nagy", "--check", "run.output", "--remove")
    assert "run.output of an earlier verdict is no longer corrected" in done.stdout
    third = grade_all(folder, out, quiet=False)
    assert third.finals() == {"Ann Lee": "20", "Bela Nagy": "100"}
    assert LAPSED not in third.output
    # undone again, the one of the first attempt is listed again
    assert override(third, "Ann Lee", "--remove").returncode == 0
    fourth = grade_all(folder, out, quiet=False)
    assert fourth.finals() == second.finals()
    assert "Ann Lee: the total of attempt 1" in lapsed(fourth)


NOW = datetime.now(timezone.utc)


def at(ledger: Ledger, key: str, sha256: str, *, lost: bool, assignment: str = "a") -> int:
    """Record a verdict on a submission under a version of the assignment."""
    return ledger.record("kim", key, submitted(sha256, lost=lost, assignment=assignment))


def submitted(sha256: str, *, lost: bool, assignment: str = "a") -> Report:
    """Return a report on a submission."""
    made = report(check("run.output", "failed" if lost else "passed"))
    submission = made.submission.model_copy(update={"sha256": sha256})
    version = made.assignment.model_copy(update={"sha256": assignment * 64})
    return made.model_copy(update={"submission": submission, "assignment": version})


@pytest.mark.parametrize("check_id", ["", "run.output"])
def test_the_same_files_keep_a_correction_if_what_it_corrected_is_the_same(
    tmp_path: Path, check_id: str
) -> None:
    with Ledger(tmp_path / "ledger.sqlite") as ledger:
        first = at(ledger, "k1", "b" * 64, lost=True)
        ledger.override(HELLO, Override("kim", check_id, 5, "x", verdict=first))
        (made,) = ledger.overrides(HELLO)
        better_grader = at(ledger, "k2", "b" * 64, lost=False)
        title_changed = at(ledger, "k3", "b" * 64, lost=True, assignment="c")
        check_changed = at(ledger, "k4", "b" * 64, lost=False, assignment="d")
        other_files = at(ledger, "k5", "e" * 64, lost=True)
        ids = (first, better_grader, title_changed, check_changed, other_files)
        found = [holds(ledger, made, n, ledger.submission_of(n)) for n in ids]
    assert found == [True, True, True, False, False]


def test_each_submission_has_a_correction_of_its_own(tmp_path: Path) -> None:
    with Ledger(tmp_path / "ledger.sqlite") as ledger:
        ids = [at(ledger, key, key * 64, lost=True) for key in "abc"]
        made = [Override("kim", "", n, "x", "lee", NOW, n, ledger.submission_of(n)) for n in ids]
        for one in made:
            ledger.override(HELLO, one)
        assert ledger.overrides(HELLO) == made
        ledger.drop_override(HELLO, made[1])
        assert ledger.overrides(HELLO) == [made[0], made[2]]


def old_ledger(
    path: Path, monkeypatch: pytest.MonkeyPatch, submissions: str, *corrections: float | None
) -> None:
    """Write the ledger of a grader that did not record which verdict a correction is about."""
    connection = sqlite3.connect(path, isolation_level=None)
    with monkeypatch.context() as patched:
        patched.setattr(ledger_schema, "STEPS", ledger_schema.STEPS[:2])
        ledger_schema.bring_up_to_date(connection)
    then = datetime.now(timezone.utc)
    columns = (
        "student, key, round, assignment, submission, distro, score, max_score, report, marked"
    )
    for key in submissions:
        made = submitted(key * 64, lost=True)
        content = zlib.compress(made.model_dump_json(by_alias=True).encode())
        row = ("kim", key, 1, made.assignment.id, key * 64, "jazzy", made.score, made.max_score)
        marks = ", ".join("?" * 10)
        connection.execute(
            f"INSERT INTO verdict ({columns}) VALUES ({marks})",
            (*row, content, (then - timedelta(minutes=1)).isoformat()),
        )
    for n, given in enumerate(corrections):
        connection.execute(
            "INSERT INTO override (student, assignment, check_id, points, because, by, at) "
            "VALUES ('kim', ?, '', ?, 'x', 'lee', ?)",
            (HELLO, given, (then + timedelta(minutes=n)).isoformat()),
        )
    connection.close()


@pytest.mark.parametrize(
    ("submissions", "verdict"), [("", 0), ("a", 1), ("ab", UNKNOWN)], ids=["none", "one", "two"]
)
def test_a_correction_in_an_older_ledger_is_of_the_only_submission_or_of_none(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, submissions: str, verdict: int
) -> None:
    path = tmp_path / "ledger.sqlite"
    old_ledger(path, monkeypatch, submissions, 10)
    with Ledger(path) as ledger:
        (made,) = ledger.overrides(HELLO)
        assert (made.points, made.verdict) == (10, verdict)
        later = at(ledger, "c", "c" * 64, lost=False)
        assert ledger.overrides(HELLO) == [made], "later verdicts change nothing"
        assert not holds(ledger, made, later, "c" * 64)
        ids = [n for n in range(1, later) if holds(ledger, made, n, ledger.submission_of(n))]
        assert ids == ([1] if submissions == "a" else [])
        assert ledger.check_chain(None).faults == []
        ledger.drop_override(HELLO, made)
        assert ledger.overrides(HELLO) == []
        assert ledger.check_chain(None).faults == []


def test_a_correction_that_an_older_grader_removed_stays_removed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "ledger.sqlite"
    old_ledger(path, monkeypatch, "a", 10, 20, None)
    with Ledger(path) as ledger:
        assert ledger.overrides(HELLO) == []


def test_without_a_noted_verdict_several_attempts_are_not_guessed(tmp_path: Path) -> None:
    with Ledger(tmp_path / "ledger.sqlite") as ledger:
        assert counting_verdict(ledger, HELLO, "kim") == 0
        ids = []
        for key in "ab":
            ids.append(at(ledger, key, key * 64, lost=True))
            row = HandedInRow("kim", key * 64, None, None, "kim", NOW)
            ledger.record_handed_in(HELLO, [row])
            if key == "a":
                assert counting_verdict(ledger, HELLO, "kim") == ids[0]
        with pytest.raises(UsageError, match="which of the 2 attempts counts"):
            counting_verdict(ledger, HELLO, "kim")
