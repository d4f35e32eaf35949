"""Mark one mutant: by looking at its files where that decides it, else by building and running it."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Mapping
from dataclasses import dataclass
from dataclasses import field
from dataclasses import replace
from pathlib import Path
from typing import NoReturn

from grader.checks.all import CHECKS
from grader.checks.registry import Failed
from grader.checks.registry import Outcome
from grader.errors import AssignmentError
from grader.events import Event
from grader.evidence import Evidence
from grader.mistakes.diagnose import diagnose
from grader.report.model import CheckResult
from grader.report.model import CheckStatus
from grader.report.model import Report
from grader.runner import Order
from grader.runner import grade
from grader.submission import take_in
from grader.validate.mutant import Mutant
from grader.validate.tree import EditError
from grader.validate.tree import Tree
from grader.validate.tree import apply_all
from grader.validate.tree import write_tree

# what is asked before anything is built
STATIC_STAGES = ("package", "source", "entry_point")


@dataclass(frozen=True)
class Marked:
    """What marking a package said: each check's status, and the mistakes of those that failed."""

    name: str
    status: Mapping[str, CheckStatus]
    mistakes: Mapping[str, str] = field(default_factory=dict)
    score: float = 0
    ran: bool = False
    seconds: float = 0

    @property
    def failed(self) -> tuple[str, ...]:
        """The checks that failed, in the order in which they are asked."""
        return tuple(check for check in CHECKS if self.status.get(check) == "failed")

    @property
    def unknown(self) -> tuple[str, ...]:
        """The checks that could not be decided."""
        open_ = ("inconclusive", "error")
        return tuple(check for check in CHECKS if self.status.get(check) in open_)

    @property
    def first_mistake(self) -> str:
        """The mistake that is named first ("" if nothing failed)."""
        return self.mistakes[self.failed[0]] if self.failed else ""


class _NeedsRun(Exception):  # noqa: N818 - no error: the files alone do not decide
    """A check asked for the build or the run."""


def mutate(mutant: Mutant, solution: Tree) -> Tree:
    """Return the package that a mutant is. Raises AssignmentError where an edit does not fit."""
    try:
        return apply_all(mutant.edits, solution)
    except EditError as error:
        place = mutant.where or mutant.name
        raise AssignmentError(f"{place}: the edits do not fit the solution: {error}") from None


def mark_files(name: str, tree: Tree, order: Order) -> Marked | None:
    """Mark a package by its files alone; None where no check fails without a build."""
    begin = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="grader-validate-") as folder:
        path = Path(folder) / "handed_in"
        write_tree(tree, path)
        found = _ask_files(path, order)
    if found is None:
        return None
    status: dict[str, CheckStatus] = {check: result.status for check, result in found.items()}
    mistakes = {check: r.mistakes[0].id for check, r in found.items() if r.mistakes}
    seconds = time.monotonic() - begin
    return Marked(name, status, mistakes, seconds=seconds)


def mark_run(name: str, tree: Tree, order: Order) -> Marked:
    """Mark a package as every submission is marked. Raises what `grade` raises."""
    with tempfile.TemporaryDirectory(prefix="grader-validate-") as folder:
        path = Path(folder) / "handed_in"
        write_tree(tree, path)
        return mark_path(name, replace(order, path=path))


def mark_path(name: str, order: Order) -> Marked:
    """Mark what lies at the order's path."""
    report = grade(order, _unheard)
    return _of_report(name, report)


def _of_report(name: str, report: Report) -> Marked:
    return Marked(
        name,
        status={check.id: check.status for check in report.checks},
        mistakes={c.id: c.mistakes[0].id for c in report.checks if c.mistakes},
        score=report.score,
        ran=True,
        seconds=report.timing.total,
    )


def _ask_files(path: Path, order: Order) -> dict[str, CheckResult] | None:
    """Ask the checks that need no build; None if they all pass or one of them needs it."""
    assignment = order.assignment
    submission = take_in(path, package=assignment.package, node_file=assignment.node_file)
    evidence = Evidence(assignment, submission, build=_needs_run, run=_needs_run)
    for use in sorted(assignment.checks, key=lambda use: tuple(CHECKS).index(use.id)):
        if use.id.partition(".")[0] not in STATIC_STAGES:
            break
        status: CheckStatus = "passed"
        mistakes = []
        blocked = any(
            evidence.results[name].status != "passed"
            for name in CHECKS[use.id].depends
            if name in evidence.results
        )
        try:
            if blocked:
                status = "skipped"
            else:
                CHECKS[use.id].function(evidence)
        except Failed as seen:
            status = "failed"
            mistakes = diagnose(seen, evidence)[0].mistakes
        except Outcome:
            status = "skipped"
        except _NeedsRun:
            return None
        evidence.results[use.id] = CheckResult(
            id=use.id, title=use.id, status=status, mistakes=mistakes, max_score=use.points
        )
    if all(result.status != "failed" for result in evidence.results.values()):
        return None
    return evidence.results


def _needs_run() -> NoReturn:
    raise _NeedsRun


def _unheard(event: Event) -> None:
    del event
