"""The statistics of a class: pure functions of a ClassResult."""

from __future__ import annotations

import math
import statistics
from collections.abc import Sequence
from dataclasses import dataclass, field

from grader.batch.model import ClassResult, GradebookEntry
from grader.report.model import CheckResult

BINS = 10
SLOWEST = 10
EXAMPLES = 3
UNKNOWN = ("inconclusive", "error")


@dataclass(frozen=True)
class Bin:
    """The submissions with `low` <= points < `high` (the last one: <= `high`)."""

    low: float
    high: float
    count: int


@dataclass(frozen=True)
class Scores:
    """The distribution of the final points of the graded submissions."""

    count: int
    median: float
    mean: float
    lowest: float
    highest: float
    bins: tuple[Bin, ...]


@dataclass
class CheckTally:
    """The results of one check in the class."""

    id: str
    title: str
    visibility: str
    passed: int = 0
    failed: int = 0
    skipped: int = 0
    unknown: int = 0

    @property
    def rate(self) -> float:
        """The share of failed results among the decided ones, 0 to 1."""
        known = self.passed + self.failed
        return self.failed / known if known else 0.0

    @property
    def clean(self) -> bool:
        """Whether all results are decided and none is a failure."""
        return not self.failed and not self.unknown


@dataclass
class MistakeTally:
    """A mistake: who made it, and at which checks."""

    id: str
    checks: list[str]
    who: list[GradebookEntry]
    examples: list[tuple[GradebookEntry, str]] = field(default_factory=list)
    """Different findings, each with the student who has it: at most EXAMPLES."""

    @property
    def addresses(self) -> list[str]:
        """The email addresses of the students, as far as they are known."""
        return list(dict.fromkeys(e.student.email for e in self.who if e.student.email))


def shown(entry: GradebookEntry, *, show_hidden: bool) -> list[CheckResult]:
    """Return the checks of an entry's report that may be shown; [] without a report."""
    if entry.report is None:
        return []
    return [c for c in entry.report.checks if show_hidden or c.visibility == "visible"]


def scores(result: ClassResult) -> Scores | None:
    """Return the distribution of the final points; None if nothing was graded."""
    finals = [e.final for e in result.entries if e.status == "graded" and e.final is not None]
    if not finals:
        return None
    return Scores(
        count=len(finals),
        median=statistics.median(finals),
        mean=statistics.fmean(finals),
        lowest=min(finals),
        highest=max(finals),
        bins=_bins(finals, result.max_score),
    )


def bin_of(final: float, most: float) -> int:
    """Return the number of the bin of some points; those beyond either end are in the end bin."""
    return min(max(math.floor(final / most * BINS), 0), BINS - 1)


def _bins(finals: Sequence[float], most: float) -> tuple[Bin, ...]:
    if most <= 0:
        return ()
    counts = [0] * BINS
    for final in finals:
        counts[bin_of(final, most)] += 1
    edges = [most * k / BINS for k in range(BINS + 1)]
    return tuple(Bin(a, b, n) for a, b, n in zip(edges, edges[1:], counts))


def checks(result: ClassResult, *, show_hidden: bool) -> list[CheckTally]:
    """Return every check, the one with the highest failure rate first."""
    found: dict[str, CheckTally] = {}
    for entry in result.entries:
        for check in shown(entry, show_hidden=show_hidden):
            tally = found.setdefault(check.id, CheckTally(check.id, check.title, check.visibility))
            if check.status in UNKNOWN:
                tally.unknown += 1
            elif check.status == "passed":
                tally.passed += 1
            elif check.status == "failed":
                tally.failed += 1
            else:
                tally.skipped += 1
    return sorted(found.values(), key=lambda tally: (-tally.rate, -tally.failed))


def mistakes(result: ClassResult, *, show_hidden: bool) -> list[MistakeTally]:
    """Return every mistake, the most frequent first; each student counts once."""
    found: dict[str, MistakeTally] = {}
    for entry in result.entries:
        for check in shown(entry, show_hidden=show_hidden):
            for mistake in check.mistakes:
                example = check.actual.strip()
                tally = found.setdefault(mistake.id, MistakeTally(mistake.id, [], []))
                known = [text for _, text in tally.examples]
                if example and example not in known and len(known) < EXAMPLES:
                    tally.examples.append((entry, example))
                if check.id not in tally.checks:
                    tally.checks.append(check.id)
                if not tally.who or tally.who[-1] is not entry:
                    tally.who.append(entry)
    return sorted(found.values(), key=lambda tally: (-len(tally.who), tally.id))


def unsure(
    result: ClassResult, *, show_hidden: bool
) -> list[tuple[GradebookEntry, list[CheckResult]]]:
    """Return the entries with undecided checks, for which the student is not to blame."""
    found = []
    for entry in result.entries:
        open_ = [c for c in shown(entry, show_hidden=show_hidden) if c.status in UNKNOWN]
        if open_:
            found.append((entry, open_))
    return found


def slowest(result: ClassResult) -> list[GradebookEntry]:
    """Return the entries whose verdicts took longest, at most SLOWEST."""
    timed = [entry for entry in result.entries if entry.report is not None]
    return sorted(timed, key=_total, reverse=True)[:SLOWEST]


def _total(entry: GradebookEntry) -> float:
    return entry.report.timing.total if entry.report is not None else 0.0
