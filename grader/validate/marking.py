"""Mark packages: by their files if that is sufficient, else on the workers that mark a class."""

from __future__ import annotations

import contextlib
import itertools
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from grader.base.unheard import unheard
from grader.batch.local_pool import LocalPool
from grader.batch.run import cores_here, prepare
from grader.batch.work import Done, Task
from grader.package.edit.tree import Tree, write_tree
from grader.package.submission import Submission
from grader.publish.class_run import MOST_A_CORE
from grader.report.model import CheckResult, CheckStatus, Report
from grader.verdict.order import Order
from grader.verdict.own_checks import static_of
from grader.verdict.static import evaluate_static
from grader.verdict.take_in import take_in_for

UNDECIDED = ("inconclusive", "error")
MOST_TRANSCRIPT = 4_000  # characters


@dataclass(frozen=True)
class Marked:
    """The result of marking a package: each check's status, and the mistakes of failed checks.

    `problem` is the reason if it could not be marked, `seconds` the duration (0 for files only),
    `transcript` the end of what the program printed, `report` the whole report if it was built.
    """

    status: Mapping[str, CheckStatus]
    mistakes: Mapping[str, str] = field(default_factory=dict)
    score: float = 0
    ran: bool = False
    seconds: float = 0
    problem: str = ""
    transcript: str = ""
    report: Report | None = None

    @property
    def failed(self) -> tuple[str, ...]:
        """The checks that failed, in the order of the assignment."""
        return tuple(check for check, status in self.status.items() if status == "failed")

    @property
    def unknown(self) -> tuple[str, ...]:
        """The checks that could not be decided."""
        return tuple(check for check, status in self.status.items() if status in UNDECIDED)

    @property
    def first_mistake(self) -> str:
        """The first mistake of the report ("" if nothing failed)."""
        return self.mistakes[self.failed[0]] if self.failed else ""


def submit(tree: Tree, order: Order) -> Submission:
    """Take in a package, and the packages beside it, as if a student had submitted it."""
    assignment = order.assignment
    with tempfile.TemporaryDirectory(prefix="grader-validate-") as folder:
        path = Path(folder) / "handed_in"
        write_tree(tree, path / assignment.package if assignment.others else path)
        return submit_path(path, order)


def submit_path(path: Path, order: Order) -> Submission:
    """Take in the package at a path."""
    return take_in_for(order.assignment, path)


def mark_files(submission: Submission, order: Order) -> Marked:
    """Mark a package by its files only, up to the first check that needs a build."""
    only = static_of(order.assignment)
    results = evaluate_static(submission, order.assignment, only=only, lang=order.lang)
    return _marked(itertools.takewhile(lambda result: result.status not in UNDECIDED, results))


def mark_all(
    work: Iterable[tuple[str, Submission]], order: Order, *, workers: int
) -> Iterator[tuple[str, Marked]]:
    """Mark packages by building and running them; yield each by name when it is done.

    `workers`: how many at once (0: as a class is marked). Raises SurroundingsError if no sandbox
    can be opened.
    """
    job = prepare(order, notify=unheard).job
    cores = cores_here()
    pool = LocalPool(job, workers or cores, most=workers or MOST_A_CORE * cores)
    tasks = (Task(name, name, name, submission.sha256, submission) for name, submission in work)
    running = pool.run(tasks, started=unheard)
    with contextlib.closing(running):
        for done in running:
            if done.answer.report is None:
                pool.prove()
            yield done.task.student, _of(done)


def _of(done: Done) -> Marked:
    report = done.answer.report
    if report is None:
        last = done.answer.fault.strip().splitlines()[-1:]
        return Marked({}, problem=last[0] if last else "the grader itself failed")
    marked = _marked(report.checks, score=report.score, ran=True, seconds=report.timing.total)
    end = report.evidence.transcript[-MOST_TRANSCRIPT:]
    return replace(marked, transcript=end, report=report)


def _marked(
    checks: Iterable[CheckResult], *, score: float = 0, ran: bool = False, seconds: float = 0
) -> Marked:
    found = {check.id: check for check in checks}
    return Marked(
        status={check_id: check.status for check_id, check in found.items()},
        mistakes={check_id: c.mistakes[0].id for check_id, c in found.items() if c.mistakes},
        score=score,
        ran=ran,
        seconds=seconds,
    )
