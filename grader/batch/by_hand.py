"""What needs a person, with why: one list for the terminal, the page and `by-hand.csv`.

The file has empty columns for points, reasons and comments: filled in, it is read by
`grader override --from by-hand.csv`.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from dataclasses import dataclass

from grader.base.plain_text import one_line
from grader.batch import cells
from grader.batch.model import ClassResult, GradebookEntry
from grader.batch.words import lapsed_words
from grader.report.model import Report

BY_HAND_FILE = "by-hand.csv"
COLUMNS = (
    *("key", "name", "section", "what", "why", "file"),
    *("check", "points", "because", "comment"),
)
UNDECIDED = ("inconclusive", "error")
MOST_WHY = 600


@dataclass(frozen=True)
class ByHand:
    """One thing that a person must look at; `check` is the check whose points are open."""

    entry: GradebookEntry
    what: str
    why: str
    check: str = ""


def by_hand(result: ClassResult) -> list[ByHand]:
    """Return all that needs a person, in the order of the class."""
    return [one for entry in result.entries for one in _of(entry)]


def _of(entry: GradebookEntry) -> Iterator[ByHand]:
    if entry.status == "unclear":
        yield ByHand(entry, "not known whose it is", "; ".join(entry.notes))
    if entry.status == "error":
        why = entry.notes[0] if entry.notes else entry.problem
        yield ByHand(entry, "the grader failed", why)
    if entry.status == "elsewhere":
        yield ByHand(entry, "submitted elsewhere", "; ".join(entry.notes))
    for reason in entry.by_hand:
        yield ByHand(entry, "nothing could be marked", reason)
    for lapsed in entry.lapsed:
        yield ByHand(entry, "a correction no longer applies", lapsed_words(lapsed))
    yield from _undecided(entry)
    if entry.is_lateness_open:
        why = "it is not known when it was handed in (--times)"
        yield ByHand(entry, "time of submission unknown", why)


def _undecided(entry: GradebookEntry) -> Iterator[ByHand]:
    if entry.report is None or entry.status != "graded":
        return
    corrected = {override.check for override in entry.overrides}
    if "" in corrected:
        return
    for check in entry.report.checks:
        if check.status in UNDECIDED and check.id not in corrected:
            why = check.actual or check.title
            yield ByHand(entry, "points not decided", why, check.id)


def by_hand_csv(result: ClassResult) -> bytes:
    """Return the list as a CSV file in UTF-8, with the byte order mark by which Excel knows it."""
    out = io.StringIO()
    table = csv.writer(out, quoting=csv.QUOTE_ALL)
    table.writerow(COLUMNS)
    for one in by_hand(result):
        student = one.entry.student
        file = _file(one.entry.report)
        who = (student.key, student.name, student.section, one.what)
        first = [cells.text(value) for value in (*who, one_line(one.why, most=MOST_WHY), file)]
        table.writerow([*first, one.check, "", "", ""])
    return out.getvalue().encode("utf-8-sig")


def _file(report: Report | None) -> str:
    return "" if report is None else report.submission.path
