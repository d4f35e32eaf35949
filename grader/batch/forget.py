"""Removes all that is kept about students; the chain of the ledger stays whole."""

from __future__ import annotations

import contextlib
import csv
import io
import shutil
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from grader.base.errors import SurroundingsError
from grader.base.shown import shown
from grader.batch.given_files import FOLDER, KINDS, write_private
from grader.batch.ledger import Ledger
from grader.batch.model import Student

BY_KEY = ("gradebook.csv", "by-hand.csv", "feedback.csv", "pseudonyms.csv")
"""Lists whose first columns name the student by key: only the row goes."""
MADE_AGAIN = (
    *("index.html", "students", "junit.xml", "join.csv", "drafts.mbox", "pseudonyms/gradebook.csv"),
    *("moodle-feedback.zip", "moodle-gradebook.csv", "moodle-worksheet.csv"),
    *("canvas-feedback.zip", "canvas-gradebook.csv", "brightspace-grades.csv"),
)
"""What is about the whole class (a page names its neighbours): the next run writes it again."""


@dataclass(frozen=True)
class Forgotten:
    """What is kept about one student: rows of the ledger by table, files, and files to look at."""

    student: Student
    rows: dict[str, int]
    files: tuple[Path, ...]
    by_hand: tuple[str, ...]


def kept_about(ledger: Ledger, out: Path, student: Student, names: Collection[str]) -> Forgotten:
    """Return what is kept about a student; `names` are those of the student's report folders."""
    files = [*_listed(out, student), *(out / name for name in names if (out / name).is_dir())]
    files += [place for name in MADE_AGAIN if (place := out / name).exists()]
    by_hand = [
        f"{place}: remove the student's row"
        for kind in KINDS
        if (place := out / FOLDER / f"{kind}.csv").is_file()
    ]
    return Forgotten(student, ledger.rows_of(student.key), tuple(files), tuple(by_hand))


def forget(ledger: Ledger, out: Path, found: Sequence[Forgotten]) -> None:
    """Remove the files, then the rows: what is interrupted in between can be done again."""
    keys = {one.student.key for one in found}
    for one in found:
        for place in one.files:
            _remove(place)
    for name in BY_KEY:
        _without(out, name, keys)
    ledger.forget(keys)


def last_seen_before(ledger: Ledger, before: datetime) -> list[Student]:
    """Return the students whose last submission was first seen before that time."""
    last: dict[str, datetime] = {}
    students: dict[str, Student] = {}
    for assignment in ledger.assignments():
        students |= {one.key: one for one in ledger.students(assignment)}
        for row in ledger.handed_in(assignment):
            last[row.student] = max(last.get(row.student, row.first_seen), row.first_seen)
    return [students[key] for key, at in last.items() if at < before and key in students]


def report_folders(ledger: Ledger, student: Student) -> set[str]:
    """Return the names of the folders that have the student's reports."""
    own = [row.id for row in ledger.verdicts().values() if row.student == student.key]
    return {ledger.report(verdict).submission.name for verdict in own}


def _listed(out: Path, student: Student) -> Iterator[Path]:
    """Yield the student's feedback files."""
    for row in _rows(out / "feedback.csv"):
        if _is_key(row.get("key", ""), {student.key}):
            for column in ("page", "text"):
                place = Path(row.get(column) or "")
                if place.parts[:1] == ("feedback",) and len(place.parts) == 2:
                    yield out / place


def _rows(place: Path) -> list[dict[str, str]]:
    with contextlib.suppress(OSError, ValueError):
        return list(csv.DictReader(io.StringIO(place.read_text("utf-8-sig"), newline="")))
    return []


def _is_key(cell: str, keys: Collection[str]) -> bool:
    return cell in keys or cell.removeprefix("'") in keys


def _without(out: Path, name: str, keys: Collection[str]) -> None:
    """Take the students' rows out of a list; the others stay as they are."""
    rows = _rows(out / name)
    kept = [row for row in rows if not _is_key(row.get("key", ""), keys)]
    if len(kept) == len(rows):
        return
    text = io.StringIO()
    table = csv.DictWriter(text, list(rows[0]), quoting=csv.QUOTE_ALL, lineterminator="\r\n")
    table.writeheader()
    table.writerows(kept)
    write_private(out, "", name, text.getvalue().encode("utf-8-sig"))


def _remove(place: Path) -> None:
    try:
        if place.is_symlink() or not place.is_dir():
            place.unlink(missing_ok=True)
        else:
            shutil.rmtree(place)
    except OSError as error:
        raise SurroundingsError(
            f"{shown(str(place))} cannot be removed: {error.strerror}",
            remedy="Nothing was removed from the ledger yet: run the same command again.",
        ) from error
