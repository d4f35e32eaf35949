"""Real verdicts of packages, and what the tests expect of a verdict."""

from __future__ import annotations

from pathlib import Path

from grader.base.unheard import unheard
from grader.course.assignment import Assignment
from grader.course.load import load_assignment
from grader.package.submission import Submission, take_in
from grader.report.events import Listener
from grader.report.model import Report
from grader.ros.distro import find_distro
from grader.sandbox.limits import Limits
from grader.verdict.evidence_file import Judged
from grader.verdict.mark import mark as mark_submission
from grader.verdict.order import Order
from grader.verdict.recording import Recording
from tests import processes
from tests.corpus.model import Package

COURSE = processes.ROOT / "lab" / "course" / "hello_time"
ASSIGNMENT = load_assignment(COURSE / "assignment.yaml")
# a package that does not end costs these, not the defaults
LIMITS = Limits().override({"build_seconds": 20, "start_seconds": 8, "run_seconds": 40})


def taken_in(path: Path, assignment: Assignment = ASSIGNMENT) -> Submission:
    """Return the submission at a path."""
    return take_in(path, package=assignment.package, node_file=assignment.node_file)


def order(
    path: Path,
    *,
    assignment: Assignment = ASSIGNMENT,
    distro: str = "jazzy",
    sandbox: str = "bubblewrap",
    lang: str = "en",
) -> Order:
    """Return the order to mark a package."""
    return Order(
        path=path,
        assignment=assignment,
        distro=find_distro(distro),
        sandbox=sandbox,
        limits=LIMITS,
        lang=lang,
        tries_fixes=False,
    )


def mark(
    path: Path,
    *,
    distro: str = "jazzy",
    sandbox: str = "bubblewrap",
    listener: Listener = unheard,
    recordings: list[Recording] | None = None,
) -> Report:
    """Build and run a package and return the report; its evidence is appended to `recordings`."""

    def keep(judged: Judged) -> None:
        if recordings is not None:
            recordings.append(judged.recording)

    wanted = order(path, distro=distro, sandbox=sandbox)
    return mark_submission(taken_in(path), wanted, listener, keep=keep)


def summary(report: Report) -> str:
    """Return what a failing test shows of a report."""
    rows = [
        f"{check.id}: {check.status} {[m.id for m in check.mistakes]} {check.actual[:300]}"
        for check in report.checks
        if check.status != "passed"
    ]
    return "\n".join([*rows, report.evidence.build_log[-1500:], report.evidence.transcript[-1500:]])


def outcomes(report: Report) -> list[tuple[str, str, float, list[str]]]:
    """Return what makes two verdicts equal: statuses, scores and mistake ids."""
    return [(c.id, c.status, c.score, [m.id for m in c.mistakes]) for c in report.checks]


def assert_full_marks(package: Package, report: Report) -> None:
    """Assert that a right package has every point."""
    assert report.score == report.max_score == 100, summary(report)
    assert report.all_passed
    assert report.observed.clock == ("wall" if package.wall_clock else "virtual")


def assert_verdict(package: Package, report: Report) -> None:
    """Assert that a report says of a package what the corpus expects."""
    failed = {check.id for check in report.checks if check.status == "failed"}
    skipped = {check.id for check in report.checks if check.status == "skipped"}
    assert failed - package.undecided == set(package.expect_failed), summary(report)
    assert skipped - package.undecided == set(package.expect_skipped), summary(report)
    for check_id, mistake in package.expect_failed.items():
        check = report.check(check_id)
        assert check.expected, check_id
        assert check.actual, check_id
        assert check.rationale or check.consequence_of, check_id
        assert check.fix, check_id
        if mistake is not None:
            assert check.mistakes[0].id == mistake, check.actual
    for check in report.checks:
        assert check.status in ("passed", "failed", "skipped")
        assert (check.blocked_by in failed) == (check.status == "skipped")
    if package.expect_score is not None:
        assert report.score == package.expect_score
    assert report.score == sum(c.max_score for c in report.checks if c.status == "passed")
