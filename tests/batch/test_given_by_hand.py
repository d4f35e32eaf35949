"""What an instructor gives by hand: corrections and comments from a CSV, groups of equal mistakes."""

from __future__ import annotations

import csv
import subprocess
from datetime import datetime, timezone
from pathlib import Path

import pytest

from grader.batch.ledger import HandedInRow, Ledger
from grader.batch.model import Student
from tests.batch.archives import write
from tests.batch.downloads import scored
from tests.batch.stub_run import Run, grade_all
from tests.processes import grader, run
from tests.report.samples import check, report

pytestmark = pytest.mark.prefix


@pytest.fixture
def marked(tmp_path: Path) -> Run:
    """A class of three: one fails, one passes, one handed in a PDF."""
    folder = tmp_path / "class"
    write(folder / "Ann Lee", scored(60))
    write(folder / "김민지", scored(100))
    write(folder / "Cleo Poe", {"report.pdf": b"%PDF-1.7\n"})
    return grade_all(folder, tmp_path / "out", quiet=False)


def again(one: Run) -> Run:
    return grade_all(one.out.parent / "class", one.out)


def override(one: Run, *words: str | Path) -> subprocess.CompletedProcess[str]:
    return run(grader("override", *words, "--out", one.out))


def filled(one: Run, name: str, **cells: str) -> Path:
    """Return the run's by-hand.csv with cells of a student's row filled in."""
    rows = one.rows("by-hand.csv")
    path = one.out.parent / "filled.csv"
    with path.open("w", encoding="utf-8", newline="") as file:
        table = csv.DictWriter(file, rows[0])
        table.writeheader()
        table.writerows({**row, **cells} if row["name"] == name else row for row in rows)
    return path


def test_the_list_of_what_needs_a_person_is_filled_in_and_read(marked: Run) -> None:
    rows = marked.rows("by-hand.csv")
    assert [(row["name"], row["what"]) for row in rows] == [("Cleo Poe", "nothing could be marked")]
    assert "by-hand.csv" in marked.output

    file = filled(marked, "Cleo Poe", points="40", because="by mail", comment="Zip it\nnext time.")
    tried = override(marked, "--from", file, "--dry-run")
    assert "Cleo Poe: the total 40 points, because: by mail" in tried.stdout
    assert again(marked).finals()["Cleo Poe"] == "", "a dry run records nothing"
    done = override(marked, "--from", file)
    assert done.returncode == 0, done.stderr
    second = again(marked)
    assert second.finals() == {"Ann Lee": "60", "김민지": "100", "Cleo Poe": "40"}
    assert second.rows("by-hand.csv") == []
    page = next((marked.out / "feedback").glob("*Cleo*.html")).read_text(encoding="utf-8")
    assert "Your instructor writes: Zip it\nnext time." in page
    same = override(marked, "--from", file)
    assert "0 recorded, 1 of these were recorded before" in same.stdout


def test_a_file_with_one_error_records_nothing(marked: Run) -> None:
    path = marked.out.parent / "own.csv"
    path.write_text(
        "student,check,points,because,comment\n"
        "Ann Lee,,90,seen in class,\n"
        "Ann Leh,,90,seen in class,\n"
        "김민지,run.outputs,1,x,\n"
        "Cleo Poe,,400,x,\n"
        "Cleo Poe,,4,,\n"
    )
    done = override(marked, "--from", path)
    assert done.returncode == 2
    for words in (
        *("own.csv:3: there is no student 'Ann Leh'", "Did you mean 'run.output'?"),
        *("own.csv:5: the total is worth 0 to 100 points", "own.csv:6: points need a reason"),
        "Nothing was recorded.",
    ):
        assert words in done.stderr
    assert override(marked, "--list").stdout == ""


def test_a_comment_is_about_what_was_handed_in(marked: Run) -> None:
    assert override(marked, "Ann Lee", "--comment", "Look at the timer.").returncode == 0
    notes = again(marked).column("gradebook.csv", "notes", "name")
    assert "comment: Look at the timer." in notes["Ann Lee"]
    write(marked.out.parent / "class/Ann Lee", scored(70))
    second = again(marked)
    pages = [p.read_text(encoding="utf-8") for p in (marked.out / "feedback").glob("*.md")]
    assert len(pages) == 3
    assert not any("Look at the timer" in page for page in pages)
    notes = second.column("gradebook.csv", "notes", "name")
    assert "your comment on another submission is not shown: Look at" in notes["Ann Lee"]
    assert override(second, "Ann Lee", "--comment", "").returncode == 0
    assert "Look at" not in again(marked).column("gradebook.csv", "notes", "name")["Ann Lee"]


def test_students_with_one_mistake_are_corrected_at_once(tmp_path: Path) -> None:
    place, mistake = tmp_path / "ledger.sqlite", [{"id": "run.spin_missing"}]
    students = [Student(key, key.title()) for key in ("ann", "bob", "cleo")]
    with Ledger(place) as ledger:
        ledger.enrol("hello_time", students)
        for one in students:
            found = mistake if one.key != "bob" else []
            failed = check("run.spins", "failed", mistakes=found, max_score=10)
            made = report(checks=[failed])
            ledger.record_handed_in("hello_time", [_row(one.key, made.submission.sha256)])
            ledger.record(one.key, "key", made)
    words = ("--mistake", "run.spin_missing", "--points", "5", "--because", "shown in class")
    command = grader("override", *words, "--ledger", place)
    tried = run([*command, "--dry-run"])
    assert tried.stdout.splitlines() == [
        "Ann: run.spins 5 points, because: shown in class",
        "Cleo: run.spins 5 points, because: shown in class",
        "2 would be recorded; nothing was",
    ]
    assert run(command).stdout.splitlines()[2] == "2 recorded"
    assert run(command).stdout.splitlines()[2] == "0 recorded, 2 of these were recorded before"
    misspelt = run(grader("override", *words[2:], "--mistake", "spin_missing", "--ledger", place))
    assert misspelt.returncode == 2
    assert "Did you mean 'run.spin_missing'?" in misspelt.stderr


def _row(student: str, submission: str) -> HandedInRow:
    seen = datetime(2026, 11, 20, tzinfo=timezone.utc)
    return HandedInRow(student, submission, None, None, "somewhere", seen)
