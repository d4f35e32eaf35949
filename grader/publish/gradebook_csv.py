"""`gradebook.csv`: all students of a class in one table, for spreadsheets."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from datetime import datetime, timezone

from grader.base.plain_text import points
from grader.batch import cells
from grader.batch.model import ClassResult, GradebookEntry
from grader.batch.points import marks
from grader.batch.words import lapsed_words

BEFORE = (
    "key",
    "name",
    "email",
    "username",
    "id_number",
    "section",
    "status",
    "score",
    "penalty",
    "final",
    "max_score",
    "attempt",
    "submitted",
    "late",
    "due",
)
AFTER = ("mistakes", "notes")
MOST_NOTES = 4_000  # characters


def gradebook_csv(result: ClassResult, *, bom: bool = False) -> bytes:
    """Return the table in UTF-8: one row per student in class order, hidden checks included.

    `bom` adds the byte order mark by which Excel recognises UTF-8. `submitted` and `due` are ISO 8601 in UTC,
    `late` is in seconds, or `unknown`, and empty without a submission. A check's cell is empty if its
    points are undecided, or if nothing could be marked.
    """
    checks = check_ids(result)
    out = io.StringIO()
    # all quoted: a spreadsheet may split at other characters than commas
    table = csv.writer(out, quoting=csv.QUOTE_ALL)
    table.writerow([*BEFORE, *(cells.text(check) for check in checks), *AFTER])
    for entry in result.entries:
        table.writerow(_row(entry, checks))
    return out.getvalue().encode("utf-8-sig" if bom else "utf-8")


def check_ids(result: ClassResult) -> list[str]:
    """Return the ids of all checks in any report, in the order of the reports."""
    reports = (entry.report for entry in result.entries)
    return list(dict.fromkeys(c.id for report in reports if report for c in report.checks))


def _row(entry: GradebookEntry, checks: Sequence[str]) -> list[str]:
    student = entry.student
    # nothing was marked: no points are not 0 points
    decided = () if entry.status == "ungradable" else marks(entry)
    given = {mark.check.id: mark.points for mark in decided}
    who = (
        student.key,
        student.name,
        student.email,
        student.username,
        student.id_number,
        student.section,
        entry.status,
    )
    return [
        *(cells.text(value) for value in who),
        cells.number(entry.score),
        cells.number(entry.penalty),
        cells.number(entry.final),
        cells.number(entry.max_score),
        str(entry.attempt),
        _instant(entry.submitted),
        _late(entry),
        _instant(entry.due),
        *(cells.number(given.get(check)) for check in checks),
        cells.text(_mistakes(entry), most=MOST_NOTES),
        cells.text(" | ".join(_notes(entry)), most=MOST_NOTES),
    ]


def _late(entry: GradebookEntry) -> str:
    if entry.status in ("missing", "elsewhere", "unclear") and entry.report is None:
        return ""
    return "unknown" if entry.late_seconds is None else cells.number(entry.late_seconds)


def _instant(value: datetime | None) -> str:
    if value is None:
        return ""
    zoned = value if value.tzinfo else value.replace(tzinfo=timezone.utc)
    return zoned.astimezone(timezone.utc).isoformat(timespec="seconds")


def _mistakes(entry: GradebookEntry) -> str:
    found = [m.id for mark in marks(entry) for m in mark.check.mistakes]
    return " ".join(dict.fromkeys(found))


def _notes(entry: GradebookEntry) -> list[str]:
    notes = [f"look at by hand: {reason}" for reason in entry.by_hand]
    notes += [*([] if entry.status == "ungradable" else [entry.problem]), *entry.notes]
    for override in entry.overrides:
        by = f" by {override.by}" if override.by else ""
        what = override.check or "the total"
        notes.append(
            f"{what} corrected{by} to {points(override.points)} because: {override.because}"
        )
    if entry.remark is not None:
        notes.append(f"comment: {' '.join(entry.remark.text.split())}")
    notes += [f"no longer applies: {lapsed_words(lapsed)}" for lapsed in entry.lapsed]
    if entry.same_as:
        notes.append(f"same content as: {', '.join(entry.same_as)}")
    if entry.report is not None:
        notes += [entry.report.message, *entry.report.submission.notes]
    return [note for note in notes if note.strip()]
