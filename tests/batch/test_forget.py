"""`grader forget`: nothing of a student is left, and the chain of hashes is still whole."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.batch.archives import write
from tests.batch.downloads import scored
from tests.batch.stub_run import Run, grade_all
from tests.processes import grader, run

pytestmark = pytest.mark.prefix
SECRET = "Zebediah"


def everything(out: Path) -> dict[str, bytes]:
    files = [path for path in out.rglob("*") if path.is_file()]
    return {f"{path.relative_to(out)}": path.read_bytes() for path in files}


@pytest.fixture
def marked(tmp_path: Path) -> Run:
    for name, score in (("Ann Lee", 60), (f"{SECRET} Quill", 70)):
        write(tmp_path / "class" / name, scored(score))
    first = grade_all(tmp_path / "class", tmp_path / "out")
    words = ("--points", "71", "--because", f"{SECRET} was ill", "--comment", f"Dear {SECRET}")
    assert run(grader("override", f"{SECRET} Quill", *words, "--out", first.out)).returncode == 0
    return grade_all(tmp_path / "class", tmp_path / "out")


def test_nothing_of_a_forgotten_student_is_left(marked: Run) -> None:
    command = grader("forget", f"{SECRET} Quill", "--out", marked.out)
    before = everything(marked.out)
    assert run(command).returncode == 2, "it removes nothing unasked"
    shown = run([*command, "--dry-run"])
    assert "1 verdict" in shown.stdout
    assert shown.stdout.splitlines()[-1] == "nothing was removed"
    assert set(everything(marked.out)) == set(before)

    done = run([*command, "--yes"])
    assert done.returncode == 0, done.stderr
    left = everything(marked.out)
    assert not [name for name in left if SECRET in name]
    assert not [name for name, content in left.items() if SECRET.encode() in content]
    checked = run(grader("verify", marked.out / "ledger.sqlite"))
    assert checked.returncode == 0, checked.stdout
    assert "removed" in checked.stdout

    # the other student has everything as before
    other = marked.out.parent / "class" / f"{SECRET} Quill"
    other.rename(marked.out.parent / "gone")
    again = grade_all(marked.out.parent / "class", marked.out)
    assert "0 to mark, 1 marked before" in again.output
    assert again.finals() == {"Ann Lee": "60"}


def test_students_of_an_earlier_year_are_forgotten_by_a_date(marked: Run) -> None:
    none = run(grader("forget", "--before", "2001-01-01", "--out", marked.out, "--yes"))
    assert none.stdout == "nothing was removed\n"
    all_ = run(grader("forget", "--before", "2999-01-01", "--out", marked.out, "--dry-run"))
    assert f"{SECRET} Quill: rows" in all_.stdout
    assert "Ann Lee: rows" in all_.stdout
    wrong = run(grader("forget", "--before", "1.3.2026", "--out", marked.out))
    assert wrong.returncode == 2
    assert "is not a day such as 2026-03-01" in wrong.stderr
