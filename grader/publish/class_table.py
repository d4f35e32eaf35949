"""The class on a terminal: one line per student, and the changes of a regrade."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from grader.base.plain_text import one_line, points
from grader.batch.ledger import Ledger, Regrade
from grader.batch.model import ClassResult, GradebookEntry
from grader.batch.points import marks
from grader.batch.words import STATES, lapsed_words
from grader.report.model import Report

if TYPE_CHECKING:
    from grader.report.page import Page

STYLES = {
    "graded": "",
    "ungradable": "bold magenta",
    "error": "bold magenta",
    "missing": "yellow",
    "elsewhere": "yellow",
    "unclear": "bold magenta",
    "pending": "cyan",
}
BY_HAND = "Look at by hand (no grade until you give one: grader override STUDENT --points N)"
LAPSED = (
    "Corrections that no longer apply, because another verdict counts now (repeat them with "
    "grader override, or remove them with --remove)"
)
MOST_NAMES = 5  # of failed checks, in one line


@dataclass(frozen=True)
class Change:
    """A student's points before and after a regrade, and the checks lost and won by it."""

    name: str
    before: float
    after: float
    lost: tuple[str, ...]
    won: tuple[str, ...]

    @property
    def is_one(self) -> bool:
        """Whether anything changed."""
        return bool(self.lost or self.won) or self.before != self.after


def class_page(result: ClassResult, *, width: int, styled: bool) -> str:
    """Return the page of a class: each student's points, and the first failed checks."""
    page = _new_page(width, styled=styled)
    page.line((one_line(result.title), "bold"))
    page.gap()
    rows = [_row(entry) for entry in result.entries]
    page.grid(["student", "points", "final", "failed"], rows)
    page.gap()
    page.line(_totals(result.entries))
    for group in result.identical:
        names = {entry.student.key: entry.student.name for entry in result.entries}
        who = ", ".join(one_line(names[key] or key, most=40) for key in group)
        page.line(f"Identical except for white space and comments: {who}")
    _look_at(page, result.entries)
    return str(page)


def _look_at(page: Page, entries: Sequence[GradebookEntry]) -> None:
    """Add what the instructor must decide: submissions without a verdict, lapsed corrections."""
    lists = [
        (BY_HAND, [(entry, reason) for entry in entries for reason in entry.by_hand]),
        (LAPSED, [(entry, lapsed_words(one)) for entry in entries for one in entry.lapsed]),
    ]
    for title, lines in lists:
        if not lines:
            continue
        page.gap()
        page.line((f"{title}:", "bold magenta"))
        for entry, text in lines:
            name = one_line(entry.student.name or entry.student.key, most=40)
            page.line(f"  {name}: {one_line(text, most=300)}")


def regrade_page(changes: Sequence[Change], *, width: int, styled: bool) -> str:
    """Return the page of a regrade: points before and after, checks lost and won."""
    page = _new_page(width, styled=styled)
    changed = [change for change in changes if change.is_one]
    same = len(changes) - len(changed)
    page.line((f"Marked again: {len(changes)}, {same} of them with the same result.", "bold"))
    if changed:
        rows = [
            [
                (one_line(change.name, most=40), ""),
                (points(change.before), ""),
                (points(change.after), "bold"),
                (_names(change.lost), "red"),
                (_names(change.won), "green"),
            ]
            for change in changed
        ]
        page.grid(["student", "before", "after", "fails now", "passes now"], rows)
    page.gap()
    return str(page)


def _new_page(width: int, *, styled: bool) -> Page:
    from grader.report.page import Page  # noqa: PLC0415 - slow, and --quiet needs none

    return Page(width=width, styled=styled)


def changes_of(ledger: Ledger, regrades: Sequence[Regrade]) -> list[Change]:
    """Return the changes of the regrades that are done, in their order."""
    now = ledger.verdicts()
    found = []
    for regrade in regrades:
        row = now[regrade.student, regrade.key]
        if row.id == regrade.before:
            continue  # it could not be marked again: the earlier verdict stays
        before, after = ledger.report(regrade.before), ledger.report(row.id)
        passed = _passed(before), _passed(after)
        found.append(
            Change(
                name=after.submission.name,
                before=before.score,
                after=after.score,
                lost=tuple(sorted(passed[0] - passed[1])),
                won=tuple(sorted(passed[1] - passed[0])),
            )
        )
    return found


def _passed(report: Report) -> set[str]:
    return {check.id for check in report.checks if check.status == "passed"}


def _row(entry: GradebookEntry) -> list[tuple[str, str]]:
    name = one_line(entry.student.name or entry.student.key, most=40)
    score = "-" if entry.score is None else f"{points(entry.score)} / {points(entry.max_score)}"
    final = "-" if entry.final is None else points(entry.final)
    style = STYLES[entry.status]
    return [(name, style), (score, ""), (final, "bold"), (_reason(entry), style)]


def _reason(entry: GradebookEntry) -> str:
    if entry.status == "elsewhere":
        return one_line("; ".join(entry.notes), most=120)
    if entry.status == "error":
        return one_line(f"not marked: {entry.notes[0] if entry.notes else entry.problem}", most=160)
    if entry.status == "ungradable":
        return "look at by hand"
    if entry.status == "unclear":
        return STATES["unclear"]
    if entry.status != "graded":
        return one_line(entry.problem or entry.status, most=120)
    failed = [mark.check.id for mark in marks(entry) if mark.check.status == "failed"]
    late = f"late: -{points(entry.penalty)}" if entry.penalty else ""
    corrected = "corrected" if entry.overrides else ""
    return ", ".join(part for part in (_names(failed), late, corrected) if part)


def _names(names: Sequence[str]) -> str:
    more = len(names) - MOST_NAMES
    shown = [one_line(name, most=60) for name in names[:MOST_NAMES]]
    return ", ".join([*shown, f"{more} more"] if more > 0 else shown)


def _totals(entries: Sequence[GradebookEntry]) -> str:
    count = Counter[str](entry.status for entry in entries)
    full = sum(1 for e in entries if e.report is not None and e.report.all_passed)
    parts = [f"{len(entries)} students", f"{count['graded']} marked ({full} with every check)"]
    words = {"ungradable": "to look at by hand", "missing": "without a submission"}
    words["elsewhere"] = "submitted elsewhere"
    words["unclear"] = STATES["unclear"]
    words["error"] = "not marked because of a fault of the grader"
    words["pending"] = "still to be marked"
    parts += [f"{count[status]} {text}" for status, text in words.items() if count[status]]
    if unknown := sum(entry.is_lateness_open for entry in entries):
        parts.append(f"{unknown} with an unknown time of submission")
    return ", ".join(parts) + "."
