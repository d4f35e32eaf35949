"""The ledger of a class: every verdict, durable once it is recorded, and never changed afterwards.

A key names all that decides a verdict (see `keys`); a student has one verdict a key, and one more
for each regrade that was asked for.
"""

from __future__ import annotations

import contextlib
import sqlite3
import zlib
from collections.abc import Iterable, Mapping
from dataclasses import astuple
from datetime import datetime, timezone
from pathlib import Path
from types import TracebackType

from grader.base.errors import SurroundingsError
from grader.batch.ledger_file import LedgerFile
from grader.batch.ledger_rows import AlreadyMarkedError, HandedInRow, Regrade, VerdictRow
from grader.batch.model import Override, Student
from grader.report.model import Report

MOST_KEPT = 250  # reports in memory: up to 0.1 MB each
VERDICT = "SELECT id, student, key, submission, score, max_score FROM verdict"


class Ledger:
    """An open ledger; use it as a context manager. `assignment` is an assignment's id."""

    def __init__(self, path: Path, *, makes: bool = True) -> None:
        """Open the ledger at `path`; all else as `LedgerFile`."""
        self._file = LedgerFile(path, makes=makes)
        self._kept: dict[int, Report] = {}
        self.path = path

    def __enter__(self) -> Ledger:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._file.close()

    def record(self, student: str, key: str, report: Report) -> int:
        """Record a verdict and return its id: it is on the disk when this returns.

        A regrade that was asked for is done with it. Raises AlreadyMarkedError where there is a
        verdict and no regrade was asked for.
        """
        with self._file.write() as connection:
            return _insert(connection, student, key, report)

    def record_for_all(self, key: str, reports: Mapping[str, Report]) -> None:
        """Record one verdict for several students, by the students' keys: for all or for none.

        Who has a verdict already, without a regrade, keeps it.
        """
        with self._file.write() as connection:
            for student, report in reports.items():
                with contextlib.suppress(AlreadyMarkedError):
                    _insert(connection, student, key, report)

    def record_fault(self, student: str, key: str, message: str) -> None:
        """Note that our own side failed; whatever verdict there is stays the one that counts."""
        with self._file.write() as connection:
            connection.execute("DELETE FROM fault WHERE student = ? AND key = ?", (student, key))
            connection.execute(
                "INSERT INTO fault (student, key, message, at) VALUES (?, ?, ?, ?)",
                (student, key, message, _now()),
            )

    def fault(self, student: str, key: str) -> str:
        """Return why the last attempt at a verdict failed, "" if it did not."""
        found = self._file.rows(
            "SELECT message FROM fault WHERE student = ? AND key = ?", (student, key)
        )
        return str(found[-1][0]) if found else ""

    def verdicts(self) -> dict[tuple[str, str], VerdictRow]:
        """Return the verdict that counts for each student and key: the last one."""
        rows = self._file.rows(f"{VERDICT} ORDER BY id")
        return {(row[1], row[2]): VerdictRow(*row) for row in rows}

    def verdict_of(self, assignment: str, student: str, submission: str) -> VerdictRow | None:
        """Return the last verdict on a content, whatever grader and distro reached it."""
        rows = self._file.rows(
            f"{VERDICT} WHERE assignment = ? AND student = ? AND submission = ? "
            "ORDER BY id DESC LIMIT 1",
            (assignment, student, submission),
        )
        return VerdictRow(*rows[0]) if rows else None

    def report(self, verdict: int) -> Report:
        """Return the report of a verdict. KeyError if there is none of this id.

        The last few are kept, since every output goes through a class from its first to its last.
        """
        if verdict in self._kept:
            return self._kept[verdict]
        report = self._read(verdict)
        while len(self._kept) >= MOST_KEPT:
            del self._kept[next(iter(self._kept))]
        self._kept[verdict] = report
        return report

    def _read(self, verdict: int) -> Report:
        rows = self._file.rows("SELECT report FROM verdict WHERE id = ?", (verdict,))
        if not rows:
            raise KeyError(verdict)
        try:
            return Report.model_validate_json(zlib.decompress(rows[0][0]))
        except (zlib.error, ValueError) as error:
            raise SurroundingsError(
                f"the ledger {self.path} holds a report that cannot be read (verdict {verdict})",
                remedy="Mark that student again: --regrade NAME.",
            ) from error

    def count(self) -> int:
        """Return how many verdicts were ever recorded."""
        return int(self._file.rows("SELECT count(*) FROM verdict")[0][0])

    def ask_again(self, verdicts: Iterable[VerdictRow]) -> None:
        """Have these verdicts reached again; it stays asked until it is done."""
        with self._file.write() as connection:
            connection.executemany(
                "INSERT OR IGNORE INTO regrade (student, key, before, asked) VALUES (?, ?, ?, ?)",
                [(row.student, row.key, row.id, _now()) for row in verdicts],
            )

    def asked_again(self) -> dict[tuple[str, str], Regrade]:
        """Return the regrades that are not done yet."""
        rows = self._file.rows("SELECT student, key, before FROM regrade")
        return {(row[0], row[1]): Regrade(*row) for row in rows}

    def see(self, assignment: str, rows: Iterable[HandedInRow]) -> None:
        """Remember what was handed in; what is known already keeps when it was first seen."""
        with self._file.write() as connection:
            connection.executemany(
                "INSERT INTO handed_in (student, assignment, submission, submitted, late, path, "
                "first_seen) VALUES (?, ?, ?, ?, ?, ?, ?) ON CONFLICT DO UPDATE SET "
                "submitted = excluded.submitted, late = excluded.late, path = excluded.path",
                [
                    (
                        *(row.student, assignment, row.submission, _text(row.submitted)),
                        *(row.late, row.path, _text(row.first_seen)),
                    )
                    for row in rows
                ],
            )

    def seen(self, assignment: str) -> list[HandedInRow]:
        """Return all that was ever handed in, in the order in which it was first seen."""
        rows = self._file.rows(
            "SELECT student, submission, submitted, late, path, first_seen FROM handed_in "
            "WHERE assignment = ? ORDER BY id",
            (assignment,),
        )
        return [
            HandedInRow(
                *(student, submission, _instant(submitted)),
                *(None if late is None else bool(late), path, datetime.fromisoformat(first)),
            )
            for student, submission, submitted, late, path, first in rows
        ]

    def enrol(self, assignment: str, students: Iterable[Student]) -> None:
        """Remember who is in the class."""
        rows = [(assignment, *astuple(student)) for student in students]
        with self._file.write() as connection:
            connection.executemany(
                "INSERT OR REPLACE INTO student (assignment, key, name, email, username, "
                "id_number, section) VALUES (?, ?, ?, ?, ?, ?, ?)",
                rows,
            )

    def students(self, assignment: str) -> list[Student]:
        """Return who was ever in the class."""
        rows = self._file.rows(
            "SELECT key, name, email, username, id_number, section FROM student "
            "WHERE assignment = ? ORDER BY rowid",
            (assignment,),
        )
        return [Student(*row) for row in rows]

    def override(self, assignment: str, override: Override) -> None:
        """Record an instructor's correction; it takes the place of an older one of its check."""
        self._put_override(assignment, override, override.points)

    def drop_override(self, assignment: str, override: Override) -> None:
        """Take a correction back; who did so, when and why stays in the ledger."""
        self._put_override(assignment, override, None)

    def _put_override(self, assignment: str, override: Override, points: float | None) -> None:
        at = _text(override.at) or _now()
        with self._file.write() as connection:
            connection.execute(
                "INSERT INTO override (student, assignment, check_id, points, because, by, at) "
                "VALUES (?, ?, ?, ?, ?, ?, ?)",
                (
                    *(override.student, assignment, override.check, points),
                    *(override.because, override.by, at),
                ),
            )

    def overrides(self, assignment: str) -> list[Override]:
        """Return the corrections that hold: one a student and check."""
        rows = self._file.rows(
            "SELECT student, check_id, points, because, by, at FROM override WHERE id IN "
            "(SELECT max(id) FROM override WHERE assignment = ? GROUP BY student, check_id) "
            "AND points IS NOT NULL ORDER BY id",
            (assignment,),
        )
        return [
            Override(student, check, points, because, by, _instant(at))
            for student, check, points, because, by, at in rows
        ]

    def corrected_since(self, at: datetime) -> set[str]:
        """Return the students who were corrected, or a correction of whom was taken back, since."""
        rows = self._file.rows("SELECT student, at FROM override")
        return {student for student, when in rows if datetime.fromisoformat(when) > at}

    def fingerprints(self) -> dict[str, str]:
        """Return the fingerprints that were worked out before, by the submission's hash."""
        return dict(self._file.rows("SELECT submission, value FROM fingerprint"))

    def keep_fingerprints(self, values: dict[str, str]) -> None:
        """Remember fingerprints by the submission's hash."""
        with self._file.write() as connection:
            connection.executemany(
                "INSERT OR REPLACE INTO fingerprint (submission, value) VALUES (?, ?)",
                list(values.items()),
            )

    def setting(self, name: str) -> str:
        """Return what was noted under a name, "" if nothing was."""
        rows = self._file.rows("SELECT value FROM setting WHERE name = ?", (name,))
        return str(rows[0][0]) if rows else ""

    def note(self, name: str, value: str) -> None:
        """Note a value under a name."""
        with self._file.write() as connection:
            connection.execute(
                "INSERT OR REPLACE INTO setting (name, value) VALUES (?, ?)", (name, value)
            )


def _insert(connection: sqlite3.Connection, student: str, key: str, report: Report) -> int:
    (rounds,) = connection.execute(
        "SELECT count(*) FROM verdict WHERE student = ? AND key = ?", (student, key)
    ).fetchone()
    asked = connection.execute(
        "DELETE FROM regrade WHERE student = ? AND key = ?", (student, key)
    ).rowcount
    if rounds and not asked:
        raise AlreadyMarkedError(f"{student}: {key}")
    content = zlib.compress(report.model_dump_json(by_alias=True).encode(), 6)
    cursor = connection.execute(
        "INSERT INTO verdict (student, key, round, assignment, submission, distro, score, "
        "max_score, report, marked) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
        (
            *(student, key, rounds + 1, report.assignment.id, report.submission.sha256),
            *(report.environment.distro, report.score, report.max_score, content, _now()),
        ),
    )
    connection.execute("DELETE FROM fault WHERE student = ? AND key = ?", (student, key))
    return int(cursor.lastrowid or 0)


def _now() -> str:
    return datetime.now(timezone.utc).isoformat()


def _text(instant: datetime | None) -> str | None:
    return None if instant is None else instant.astimezone(timezone.utc).isoformat()


def _instant(text: str | None) -> datetime | None:
    return None if text is None else datetime.fromisoformat(text)
