"""The result of validating an assignment: mutants against checks, as a table and as JSON."""

from __future__ import annotations

import json
from dataclasses import dataclass

from grader.validate.marking import Marked
from grader.validate.mutant import Mutant

SIGNS = {"passed": "·", "failed": "x", "skipped": "-", "inconclusive": "?", "error": "!"}
MOST_NAME = 52  # characters of a mutant's name in the table


@dataclass(frozen=True)
class MutantResult:
    """A mutant and the result of marking it."""

    mutant: Mutant
    marked: Marked

    @property
    def hit(self) -> bool:
        """Whether an expected check failed."""
        return any(self.mutant.is_hit_by(check) for check in self.marked.failed)

    @property
    def survived(self) -> bool:
        """Whether nothing failed."""
        return not (self.marked.failed or self.marked.unknown or self.marked.problem)

    @property
    def right(self) -> bool:
        """Whether every check passed."""
        return {*self.marked.status.values()} == {"passed"}

    @property
    def mistake_first(self) -> bool:
        """Whether the expected mistake comes first."""
        return not self.mutant.mistake or self.marked.first_mistake == self.mutant.mistake

    @property
    def fault(self) -> str:
        """What differs from the expectation ("" if nothing does)."""
        if self.marked.problem:
            return f"not marked: {self.marked.problem}"
        if self.mutant.equivalent:
            return "" if self.right else "explained as equivalent, but it did not pass every check"
        if self.marked.unknown:
            return f"undecided: {', '.join(self.marked.unknown)}"
        if self.survived:
            return "survived"
        if not self.hit:
            return f"did not fail at {' or '.join(self.mutant.families)}"
        if not self.mistake_first:
            return f"the first mistake is {self.marked.first_mistake}, not {self.mutant.mistake}"
        return ""


@dataclass(frozen=True)
class Matrix:
    """All rows, and the results of the solution and the starter (None: not marked)."""

    assignment: str
    checks: tuple[str, ...]
    max_score: float
    rows: tuple[MutantResult, ...]
    left_out: int
    solution: Marked | None = None
    starter: Marked | None = None
    seconds: float = 0

    @property
    def faults(self) -> tuple[str, ...]:
        """All deviations from the expectation, one line each."""
        found = []
        if self.solution and self.solution.score < self.max_score:
            found.append(f"the solution does not get full marks: {_wanting(self.solution)}")
        if self.starter and self.starter.score >= self.max_score:
            found.append("the starter gets full marks")
        found += [f"{row.mutant.name}: {row.fault}" for row in self.rows if row.fault]
        found += [f"no mutant fails {check}" for check in self.never_failed]
        return tuple(found)

    @property
    def never_failed(self) -> tuple[str, ...]:
        """The checks that no mutant fails; empty unless every mutant was marked."""
        if self.left_out:
            return ()
        failed = {check for row in self.rows for check in row.marked.failed}
        return tuple(check for check in self.checks if check not in failed)

    def figures(self) -> dict[str, int]:
        """Return the counts for the summary."""
        wrong = [row for row in self.rows if not row.mutant.equivalent]
        named = [row for row in wrong if row.mutant.mistake]
        return {
            "mutants": len(self.rows),
            "named": len(named),
            "automatic": sum(not row.mutant.named for row in self.rows),
            "equivalent": len(self.rows) - len(wrong),
            "failed_where_they_must": sum(row.hit for row in wrong),
            "that_must_fail": len(wrong),
            "mistake_named_first": sum(row.hit and row.mistake_first for row in named),
            "left_out": self.left_out,
        }


def table(matrix: Matrix) -> str:
    """Return the matrix as text: a row for each mutant, a column for each check."""
    width = min(MOST_NAME, max((len(row.mutant.name) for row in matrix.rows), default=6))
    checks = matrix.checks
    lines = [f"{n:>3}  {check}" for n, check in enumerate(checks, 1)]
    lines += [
        "     X failed as expected, x failed too, · passed, - skipped, ? undecided, blank: not run",
        "",
    ]
    heads = " ".join(f"{n:>2}" for n in range(1, len(checks) + 1))
    lines.append(f"{'mutant':<{width}}  {heads}  first mistake")
    for row in matrix.rows:
        signs = " ".join(f"{_sign(row, check):>2}" for check in checks)
        note = row.marked.first_mistake
        if row.fault:
            note = f"{note}  <-- {row.fault}".strip()
        elif row.mutant.equivalent:
            note = f"equivalent: {row.mutant.equivalent}"
        lines.append(f"{_cut(row.mutant.name, width):<{width}}  {signs}  {note}".rstrip())
    return "\n".join(lines)


def summary(matrix: Matrix) -> str:
    """Return the summary, with all deviations from the expectation."""
    figures = matrix.figures()
    lines = []
    for title, marked in (("solution", matrix.solution), ("starter", matrix.starter)):
        if marked:
            lines.append(f"{title:<24}{marked.score:g} of {matrix.max_score:g}")
    share = f"{figures['failed_where_they_must']} of {figures['that_must_fail']}"
    mistakes = f"{figures['mistake_named_first']} of {figures['named']}"
    lines += [
        f"{'mutants':<24}{figures['mutants']} ({figures['named']} with an expected mistake)",
        f"{'failed as expected':<24}{share}",
        f"{'mistake found first':<24}{mistakes}",
        f"{'equivalent':<24}{figures['equivalent']}, each explained",
    ]
    if matrix.left_out:
        lines.append(f"{'not marked':<24}{matrix.left_out}")
    lines.append(f"{'time':<24}{matrix.seconds:.0f} s")
    if matrix.faults:
        lines += ["", f"Not as expected ({len(matrix.faults)}):"]
        lines += [f"  {fault}" for fault in matrix.faults]
    return "\n".join(lines)


def as_json(matrix: Matrix) -> str:
    """Return the matrix as JSON: `checks` and `rows` in the table's order, times in seconds."""
    content = {
        "schema": 1,
        "assignment": matrix.assignment,
        "checks": matrix.checks,
        "as_expected": not matrix.faults,
        "figures": matrix.figures(),
        "never_failed": matrix.never_failed,
        "faults": matrix.faults,
        "seconds": round(matrix.seconds, 3),
        "rows": [_json_row(row) for row in matrix.rows],
    }
    return json.dumps(content, indent=1, ensure_ascii=False) + "\n"


def _wanting(marked: Marked) -> str:
    """Return the reason for missing points."""
    return marked.problem or ", ".join((*marked.failed, *marked.unknown))


def _json_row(row: MutantResult) -> dict[str, object]:
    printed = {"transcript": row.marked.transcript} if row.fault else {}
    return {
        "mutant": row.mutant.name,
        "named": row.mutant.named,
        "expected": {"checks": row.mutant.families, "mistake": row.mutant.mistake},
        "equivalent": row.mutant.equivalent,
        "status": dict(row.marked.status),
        "mistakes": dict(row.marked.mistakes),
        "ran": row.marked.ran,
        "fault": row.fault,
        "seconds": round(row.marked.seconds, 3),
        **printed,
    }


def _sign(row: MutantResult, check: str) -> str:
    status = row.marked.status.get(check)
    if status is None:
        return ""
    return "X" if status == "failed" and row.mutant.is_hit_by(check) else SIGNS[status]


def _cut(name: str, width: int) -> str:
    return name if len(name) <= width else f"{name[: width - 1]}…"
