"""The ledger of a class: every verdict, durable once recorded and never changed afterwards.

A student has one verdict for each key (see `verdict_key`), and one more for each regrade.
"""

from __future__ import annotations

import contextlib
import sqlite3
import zlib
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import asdict, dataclass
from datetime import datetime, timezone
from pathlib import Path
from types import TracebackType

from grader.base.errors import SurroundingsError
from grader.base.signing import PublicKey, SigningKey, own_key
from grader.batch import ledger_chain
from grader.batch.ledger_file import LedgerFile
from grader.batch.ledger_forget import forget, rows_of
from grader.batch.ledger_overrides import recorded_overrides
from grader.batch.ledger_rows import put, remove
from grader.batch.ledger_schema import schema_faults
from grader.batch.model import Override, Remark, Student
from grader.report.model import Report

MOST_KEPT = 250  # reports in memory: up to 0.1 MB each
VERDICT = "SELECT id, student, key, submission, score, max_score FROM verdict"


class AlreadyMarkedError(Exception):
    """The student already has a verdict for this key, and no regrade was requested."""


@dataclass(frozen=True)
class VerdictRow:
    """A verdict without its report."""

    id: int
    student: str
    key: str
    submission: str
    score: float
    max_score: float


@dataclass(frozen=True)
class HandedInRow:
    """A submission of a student; `submitted` is the system's time stamp."""

    student: str
    submission: str
    submitted: datetime | None
    late: bool | None
    path: str
    first_seen: datetime
    late_seconds: float | None = None
    extension: datetime | None = None


@dataclass(frozen=True)
class Regrade:
    """A verdict that is to be reached again, and the id of the earlier one."""

    student: str
    key: str
    before: int


class Ledger:
    """An open ledger; use it as a context manager. `assignment` is an assignment's id."""

    def __init__(self, path: Path, *, makes: bool = True) -> None:
        """Open the ledger at `path`; `makes` and errors as in `LedgerFile`."""
        self._signing = own_key()  # first: a key that cannot be used ends nothing half done
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

    def record(self, student: str, key: str, report: Report, *, evidence: bytes = b"") -> int:
        """Record a verdict and return its id; it is on the disk when this returns.

        Completes a requested regrade. Raises AlreadyMarkedError if there is a verdict and no
        regrade was requested.
        """
        with self._file.write() as connection:
            return _insert(connection, student, key, report, evidence, self._signing)

    def record_for_all(
        self,
        key: str,
        reports: Mapping[str, Report],
        *,
        evidence: Callable[[Report], bytes] = lambda _: b"",
    ) -> None:
        """Record the verdicts of a group's members, by their keys: all of them or none.

        A member who already has a verdict, and no requested regrade, keeps it. `evidence` returns
        the content of a report's evidence file, b"" if there is none.
        """
        with self._file.write() as connection:
            for student, report in reports.items():
                with contextlib.suppress(AlreadyMarkedError):
                    _insert(connection, student, key, report, evidence(report), self._signing)

    def record_fault(self, student: str, key: str, message: str) -> None:
        """Record that the grader failed; an earlier verdict still counts."""
        with self._file.write() as connection:
            row = {"student": student, "key": key, "message": message, "at": _now()}
            put(connection, "fault", row, self._signing, unique=("student", "key"))

    def fault(self, student: str, key: str) -> str:
        """Return why the last try failed, "" if it did not."""
        found = self._file.rows(
            "SELECT message FROM fault WHERE student = ? AND key = ?", (student, key)
        )
        return str(found[-1][0]) if found else ""

    def verdicts(self) -> dict[tuple[str, str], VerdictRow]:
        """Return the last verdict of each student and key: the one that counts."""
        rows = self._file.rows(f"{VERDICT} ORDER BY id")
        return {(row[1], row[2]): VerdictRow(*row) for row in rows}

    def verdict_of(self, assignment: str, student: str, submission: str) -> VerdictRow | None:
        """Return the last verdict on a submission's hash, from any grader and distro."""
        rows = self._file.rows(
            f"{VERDICT} WHERE assignment = ? AND student = ? AND submission = ? "
            "ORDER BY id DESC LIMIT 1",
            (assignment, student, submission),
        )
        return VerdictRow(*rows[0]) if rows else None

    def submission_of(self, verdict: int) -> str:
        """Return the hash of the submission that a verdict is about, "" if there is no such verdict."""
        rows = self._file.rows("SELECT submission FROM verdict WHERE id = ?", (verdict,))
        return str(rows[0][0]) if rows else ""

    def report(self, verdict: int) -> Report:
        """Return the report of a verdict; raise KeyError if there is none of this id.

        The latest reports are cached, because every output goes through the whole class.
        """
        if verdict in self._kept:
            return self._kept[verdict]
        report = self._read(verdict)
        while len(self._kept) >= MOST_KEPT:
            del self._kept[next(iter(self._kept))]
        self._kept[verdict] = report
        return report

    def evidence(self, verdict: int) -> bytes:
        """Return the content of a verdict's evidence file, b"" if there is none."""
        rows = self._file.rows("SELECT evidence FROM verdict WHERE id = ?", (verdict,))
        if not rows or rows[0][0] is None:
            return b""
        try:
            return zlib.decompress(rows[0][0])
        except (zlib.error, TypeError) as error:
            raise SurroundingsError(
                f"the ledger {self.path} holds evidence that cannot be read (verdict {verdict})"
            ) from error

    def verdict_of_report(self, report: Report) -> int:
        """Return the id of the verdict with exactly this report; raise KeyError if there is none."""
        rows = self._file.rows(
            "SELECT id FROM verdict WHERE submission = ? ORDER BY id DESC",
            (report.submission.sha256,),
        )
        for (verdict,) in rows:
            if self.report(verdict) == report:
                return int(verdict)
        raise KeyError(report.submission.name)

    def check_chain(self, key: PublicKey | None) -> ledger_chain.ChainCheck:
        """Check the chain of all rows, and with a key its signatures; and the tables themselves."""
        with self._file.write() as connection:  # so that nothing is added meanwhile
            found = ledger_chain.check_chain(connection, key)
            found.faults += schema_faults(connection)
            return found

    def _read(self, verdict: int) -> Report:
        rows = self._file.rows("SELECT report FROM verdict WHERE id = ?", (verdict,))
        if not rows:
            raise KeyError(verdict)
        try:
            return Report.model_validate_json(zlib.decompress(rows[0][0]))
        except (zlib.error, TypeError, ValueError) as error:
            raise SurroundingsError(
                f"the ledger {self.path} holds a report that cannot be read (verdict {verdict})",
                remedy="Mark that student again: --regrade NAME.",
            ) from error

    def counts(self) -> dict[str, int]:
        """Return the number of rows of each table that the chain covers."""
        tables = ledger_chain.TABLES
        query = " UNION ALL ".join(f"SELECT '{t}', count(*) FROM {t}" for t in tables)  # noqa: S608
        return {str(name): int(count) for name, count in self._file.rows(query)}

    def verdict_ids(self) -> list[int]:
        """Return the ids of all verdicts, in the order in which they were recorded."""
        return [int(row[0]) for row in self._file.rows("SELECT id FROM verdict ORDER BY id")]

    def count(self) -> int:
        """Return the number of verdicts recorded so far."""
        return int(self._file.rows("SELECT count(*) FROM verdict")[0][0])

    def request_regrades(self, verdicts: Iterable[VerdictRow]) -> None:
        """Request that these verdicts be reached again; a request is kept until it is done."""
        with self._file.write() as connection:
            for one in verdicts:
                row = {"student": one.student, "key": one.key, "before": one.id, "asked": _now()}
                unique, keeps = ("student", "key"), ("before", "asked")
                put(connection, "regrade", row, self._signing, unique=unique, keeps=keeps)

    def pending_regrades(self) -> dict[tuple[str, str], Regrade]:
        """Return the regrades that are not done yet."""
        rows = self._file.rows("SELECT student, key, before FROM regrade")
        return {(row[0], row[1]): Regrade(*row) for row in rows}

    def record_handed_in(self, assignment: str, rows: Iterable[HandedInRow]) -> None:
        """Record submissions; a known one keeps the time when it was first seen."""
        with self._file.write() as connection:
            for one in rows:
                row = {
                    "student": one.student,
                    "assignment": assignment,
                    "submission": one.submission,
                    "submitted": _text(one.submitted),
                    "late": one.late,
                    "path": one.path,
                    "first_seen": _text(one.first_seen),
                    "late_seconds": one.late_seconds,
                    "extension": _text(one.extension),
                }
                unique, keeps = ("student", "assignment", "submission"), ("first_seen",)
                put(connection, "handed_in", row, self._signing, unique=unique, keeps=keeps)

    def handed_in(self, assignment: str) -> list[HandedInRow]:
        """Return all submissions so far, in the order in which they were first seen."""
        rows = self._file.rows(
            "SELECT student, submission, submitted, late, path, first_seen, late_seconds, extension "
            "FROM handed_in WHERE assignment = ? ORDER BY id",
            (assignment,),
        )
        return [
            HandedInRow(
                *(student, submission, _instant(submitted)),
                *(None if late is None else bool(late), path, datetime.fromisoformat(first)),
                *(late_seconds, _instant(extension)),
            )
            for student, submission, submitted, late, path, first, late_seconds, extension in rows
        ]

    def enrol(self, assignment: str, students: Iterable[Student]) -> None:
        """Record the students of the class."""
        with self._file.write() as connection:
            for student in students:
                row = {"assignment": assignment, **asdict(student)}
                put(connection, "student", row, self._signing, unique=("assignment", "key"))

    def students(self, assignment: str) -> list[Student]:
        """Return all students recorded so far."""
        rows = self._file.rows(
            "SELECT key, name, email, username, id_number, section FROM student "
            "WHERE assignment = ? ORDER BY id",
            (assignment,),
        )
        return [Student(*row) for row in rows]

    def override(self, assignment: str, override: Override) -> None:
        """Record an instructor's correction; it replaces one of the same check and submission."""
        self._put_override(assignment, override, override.points)

    def drop_override(self, assignment: str, override: Override) -> None:
        """Remove a correction; who did so, when and why stays in the ledger."""
        self._put_override(assignment, override, None)

    def _put_override(self, assignment: str, override: Override, points: float | None) -> None:
        at = _text(override.at) or _now()
        with self._file.write() as connection:
            row = {
                "student": override.student,
                "assignment": assignment,
                "check_id": override.check,
                "points": points,
                "because": override.because,
                "by": override.by,
                "at": at,
                "verdict": override.verdict,
            }
            put(connection, "override", row, self._signing)

    def overrides(self, assignment: str) -> list[Override]:
        """Return the corrections that were not removed, in the order in which they were made.

        They are the last ones of each student and check, for each submission that was corrected.
        """
        return recorded_overrides(self._file, assignment)

    def corrected_since(self, at: datetime) -> set[str]:
        """Return the students with a correction that was made or removed since then."""
        rows = self._file.rows("SELECT student, at FROM override")
        return {student for student, when in rows if datetime.fromisoformat(when) > at}

    def remark(self, assignment: str, remark: Remark) -> None:
        """Record what an instructor wrote to a student: it replaces what was written before."""
        with self._file.write() as connection:
            row = {
                "student": remark.student,
                "assignment": assignment,
                "submission": remark.submission,
                "text": remark.text,
                "by": remark.by,
                "at": _text(remark.at) or _now(),
            }
            put(connection, "remark", row, self._signing, unique=("student", "assignment"))

    def drop_remark(self, assignment: str, student: str) -> None:
        """Remove what an instructor wrote to a student, and its text."""
        with self._file.write() as connection:
            remove(
                connection,
                "remark",
                {"student": student, "assignment": assignment},
                self._signing,
            )

    def remarks(self, assignment: str) -> dict[str, Remark]:
        """Return what an instructor wrote, by the student's key."""
        rows = self._file.rows(
            "SELECT student, text, by, at, submission FROM remark WHERE assignment = ?",
            (assignment,),
        )
        return {row[0]: Remark(row[0], row[1], row[2], _instant(row[3]), row[4]) for row in rows}

    def rows_of(self, student: str) -> dict[str, int]:
        """Return how many rows of a student each table has."""
        return rows_of(self._file, student)

    def forget(self, students: Collection[str]) -> None:
        """Remove all rows of these students from the tables and from the file."""
        self._kept.clear()
        forget(self._file, students, self._signing)

    def assignments(self) -> list[str]:
        """Return the ids of the assignments of which there are students."""
        rows = self._file.rows("SELECT DISTINCT assignment FROM student")
        return [str(row[0]) for row in rows]

    def fingerprints(self) -> dict[str, str]:
        """Return the recorded fingerprints, by the submission's hash."""
        return dict(self._file.rows("SELECT submission, value FROM fingerprint"))

    def keep_fingerprints(self, values: dict[str, str]) -> None:
        """Record fingerprints, by the submission's hash."""
        with self._file.write() as connection:
            connection.executemany(
                "INSERT OR REPLACE INTO fingerprint (submission, value) VALUES (?, ?)",
                list(values.items()),
            )

    def setting(self, name: str) -> str:
        """Return the value stored under a name, "" if there is none."""
        rows = self._file.rows("SELECT value FROM setting WHERE name = ?", (name,))
        return str(rows[0][0]) if rows else ""

    def note(self, name: str, value: str) -> None:
        """Store a value under a name."""
        with self._file.write() as connection:
            row = {"name": name, "value": value}
            put(connection, "setting", row, self._signing, unique=("name",))


def _insert(
    connection: sqlite3.Connection,
    student: str,
    key: str,
    report: Report,
    evidence: bytes,
    signing: SigningKey | None,
) -> int:
    (rounds,) = connection.execute(
        "SELECT count(*) FROM verdict WHERE student = ? AND key = ?", (student, key)
    ).fetchone()
    regrades = remove(connection, "regrade", {"student": student, "key": key}, signing)
    if rounds and not regrades:
        raise AlreadyMarkedError(f"{student}: {key}")
    row = {
        "student": student,
        "key": key,
        "round": rounds + 1,
        "assignment": report.assignment.id,
        "submission": report.submission.sha256,
        "distro": report.environment.distro,
        "score": report.score,
        "max_score": report.max_score,
        "report": zlib.compress(report.model_dump_json(by_alias=True).encode(), 6),
        "evidence": zlib.compress(evidence, 6) if evidence else None,
        "marked": _now(),
    }
    verdict = put(connection, "verdict", row, signing)
    remove(connection, "fault", {"student": student, "key": key}, signing)
    return verdict


def _now() -> str:
    return datetime.now(timezone.utc).isoformat()


def _text(instant: datetime | None) -> str | None:
    return None if instant is None else instant.astimezone(timezone.utc).isoformat()


def _instant(text: str | None) -> datetime | None:
    return None if text is None else datetime.fromisoformat(text)
