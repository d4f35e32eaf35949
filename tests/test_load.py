"""A verdict does not depend on the load of the machine.

The long part marks forty packages three times alone, one after the other, and three times beside thirty
busy processes, sixteen verdicts at a time: each has less than a twentieth of a core. It prints a table.
`make test-long PYTEST_ARGS="-n 0 tests/test_load.py -k draw_circle"` takes a part.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, field
from multiprocessing import get_context
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
AT_ONCE = 16  # verdicts beside the busy processes: they wait for each other too
MOST_UNDECIDED = 0.05  # of the verdicts beside busy processes
CASES = {case.name: case for case in cases()}
IN_CI = {"hello_time-first_callback_raises": (80, ["run.output"]), "hello_time-solution": (100, [])}
"""The scores, and the checks that fail."""
CI_BUSY = 8
Outcome = tuple[str, float, tuple[str, ...]]


@contextmanager
def busy(count: int) -> Iterator[None]:
    """Keep every core busy with other work, each in a session of its own.

    (Linux shares the cores between sessions first: thirty processes of one would get the time of one.)
    """
    endless = ["sh", "-c", "while :; do :; done"]
    work = [subprocess.Popen(endless, start_new_session=True) for _ in range(count)]
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


def timed(name: str, folder: Path) -> tuple[str, Report, float]:
    """Mark the package written to `folder`; return its name, the report and how long it took (s)."""
    begin = time.monotonic()
    report = marked(CASES[name], folder)
    return name, report, time.monotonic() - begin


@pytest.fixture(scope="module")
def rows(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> dict[str, Row]:
    """The verdicts of the packages whose tests run, by the packages' names; their table is printed."""
    names = [
        str(item.callspec.params["name"])
        for item in request.session.items
        if isinstance(item, pytest.Function) and {"rows", "name"} <= set(item.fixturenames)
    ]
    folders = {n: written(CASES[n], tmp_path_factory.mktemp("package")) for n in names}
    found = {name: Row(name) for name in names}
    reporter = request.config.pluginmanager.getplugin("terminalreporter")
    print_line = reporter.write_line if reporter is not None else print
    for name, folder in folders.items():
        for _ in range(TIMES):
            _, report, seconds = timed(name, folder)
            found[name].alone.append(report)
            found[name].seconds.append(seconds)
        print_line(f"{name:60} alone: {found[name].seconds[-1]:.0f} s")
    print_line(f"\n{'package':60} {'alone':>14} {'':8} {'beside others':>16} {'':8} undecided")
    # (each in a session of its own, as in a terminal of its own)
    workers = ProcessPoolExecutor(AT_ONCE, get_context("spawn"), initializer=os.setsid)
    with busy(BUSY), workers as pool:
        orders = [(name, folder) for name, folder in folders.items() for _ in range(TIMES)]
        for name, report, seconds in pool.map(timed, *zip(*orders, strict=True)):
            row = found[name]
            row.beside.append(report)
            row.seconds.append(seconds)
            if len(row.beside) == TIMES:
                print_line(str(row))
    return found


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
@pytest.mark.timeout(0)
@pytest.mark.parametrize("name", CASES)
def test_a_verdict_beside_thirty_busy_processes_is_the_same(
    name: str, rows: dict[str, Row]
) -> None:
    assert_equal(rows[name])


@pytest.mark.long
@pytest.mark.timeout(0)
def test_few_verdicts_beside_thirty_busy_processes_are_undecided(rows: dict[str, Row]) -> None:
    marked_beside = sum(len(row.beside) for row in rows.values())
    undecided = sum(row.undecided for row in rows.values())
    assert undecided <= max(1.0, MOST_UNDECIDED * marked_beside), f"of {marked_beside}"


def test_there_are_forty_packages() -> None:
    assert len(CASES) == 40


@pytest.mark.full
@pytest.mark.parametrize("name", IN_CI)
def test_a_verdict_beside_eight_busy_processes_is_the_same(name: str, tmp_path: Path) -> None:
    with busy(CI_BUSY):
        report = marked(CASES[name], written(CASES[name], tmp_path))
    failed = [check.id for check in report.checks if check.status == "failed"]
    assert (report.score, failed) == IN_CI[name], summary(report)
    assert report.inconclusive == 0, summary(report)
