"""A verdict does not depend on the load of the machine.

The long part marks forty packages three times alone and three times beside thirty busy processes,
and prints a table. `make test-long PYTEST_ARGS="-n 0 tests/test_load.py -k draw_circle"` takes a part.
"""

from __future__ import annotations

import statistics
import subprocess
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from grader.base.unheard import unheard
from grader.report.model import Report
from grader.ros.distro import find_distro
from grader.sandbox.limits import Limits
from grader.verdict.mark import grade
from grader.verdict.order import Order
from tests.load.packages import Case, cases
from tests.marking import summary

pytestmark = pytest.mark.alone
TIMES = 3
BUSY = 30
MOST_UNDECIDED = 0.05  # of the verdicts beside busy processes
CASES = {case.name: case for case in cases()}
IN_CI = ("hello_time-first_callback_raises", "hello_time-solution")
CI_BUSY = 8
Outcome = tuple[str, float, tuple[str, ...]]


@contextmanager
def busy(count: int) -> Iterator[None]:
    """Keep every core busy with other work."""
    work = [subprocess.Popen(["sh", "-c", "while :; do :; done"]) for _ in range(count)]
    try:
        yield
    finally:
        for process in work:
            process.kill()
            process.wait()


def marked(case: Case, folder: Path) -> Report:
    assignment = case.assignment(folder)
    return grade(
        Order(
            path=folder / "handed_in",
            assignment=assignment,
            distro=find_distro("jazzy"),
            sandbox="bubblewrap",
            limits=Limits().override(assignment.limits),
        ),
        unheard,
    )


def written(case: Case, folder: Path) -> Path:
    """Write a case's package to `folder/handed_in`; return the folder."""
    made = case.write(folder / "made") if case.name.startswith("hello") else case.write(folder)
    if made != folder / "handed_in":
        made.rename(folder / "handed_in")
    return folder


def outcomes(report: Report) -> dict[str, Outcome]:
    """Return what makes verdicts equal: statuses, scores and mistake ids, by the check's id."""
    return {c.id: (c.status, c.score, tuple(m.id for m in c.mistakes)) for c in report.checks}


def differing(expected: dict[str, Outcome], report: Report) -> list[str]:
    """Return how a verdict differs, apart from what it leaves undecided."""
    return [
        f"{check}: {expected[check]} alone, {found} beside others ({report.check(check).actual})"
        for check, found in outcomes(report).items()
        if found != expected[check] and found[0] != "inconclusive"
    ]


@dataclass
class Row:
    """The verdicts of one package, alone and beside busy processes, and how long each took (s)."""

    name: str
    alone: list[Report] = field(default_factory=list)
    beside: list[Report] = field(default_factory=list)
    seconds: list[float] = field(default_factory=list)

    @property
    def undecided(self) -> int:
        """How many verdicts beside busy processes leave something open."""
        return sum(report.inconclusive > 0 for report in self.beside)

    def __str__(self) -> str:
        scores = [" ".join(f"{r.score:g}" for r in made) for made in (self.alone, self.beside)]
        half = len(self.alone)
        times = [
            statistics.median(part or [0]) for part in (self.seconds[:half], self.seconds[half:])
        ]
        return (
            f"{self.name:60} {scores[0]:>14} {times[0]:6.0f} s {scores[1]:>16} {times[1]:6.0f} s"
            f" {self.undecided or '':>3}"
        )


@pytest.fixture(scope="module")
def rows(request: pytest.FixtureRequest) -> Iterator[list[Row]]:
    """The rows of the table, which is printed at the end."""
    found: list[Row] = []
    yield found
    if not found:
        return
    reporter = request.config.pluginmanager.getplugin("terminalreporter")
    print_line = reporter.write_line if reporter is not None else print
    print_line(f"\n{'package':60} {'alone':>14} {'':8} {'beside others':>16} {'':8} undecided")
    for row in found:
        print_line(str(row))
    marked_beside = sum(len(row.beside) for row in found)
    undecided = sum(row.undecided for row in found)
    print_line(f"undecided beside others: {undecided} of {marked_beside}")
    assert undecided <= max(1.0, MOST_UNDECIDED * marked_beside)


def mark_all(case: Case, folder: Path, *, times: int, count: int) -> Row:
    """Mark a package alone and beside busy processes."""
    row = Row(case.name)
    for made, others in ((row.alone, 0), (row.beside, count)):
        with busy(others):
            for _ in range(times):
                begin = time.monotonic()
                made.append(marked(case, folder))
                row.seconds.append(time.monotonic() - begin)
    return row


def assert_equal(row: Row) -> None:
    """Assert that the verdicts are equal, but for what is undecided beside busy processes."""
    first: Report = row.alone[0]
    expected = outcomes(first)
    for report in row.alone:
        assert outcomes(report) == expected, summary(report)
        assert report.inconclusive == 0, summary(report)
    for report in row.beside:
        found: Sequence[str] = differing(expected, report)
        assert not found, "\n".join([*found, summary(report)])


@pytest.mark.long
@pytest.mark.parametrize("name", CASES)
def test_a_verdict_beside_thirty_busy_processes_is_the_same(
    name: str, tmp_path: Path, rows: list[Row]
) -> None:
    row = mark_all(CASES[name], written(CASES[name], tmp_path), times=TIMES, count=BUSY)
    rows.append(row)
    assert_equal(row)


def test_there_are_forty_packages() -> None:
    assert len(CASES) == 40


@pytest.mark.full
@pytest.mark.parametrize("name", IN_CI)
def test_a_verdict_beside_eight_busy_processes_is_the_same(name: str, tmp_path: Path) -> None:
    row = mark_all(CASES[name], written(CASES[name], tmp_path), times=1, count=CI_BUSY)
    assert_equal(row)
    assert row.undecided == 0
