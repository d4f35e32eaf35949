"""The verdicts on the whole corpus.

Right variants get full marks; each broken package fails the expected checks for the expected reason,
and only checks that depend on these are skipped; hostile ones harm nothing.
"""

from __future__ import annotations

import json
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from grader.base.cache import cache_root
from grader.course.assignment import load_assignment
from grader.report.events import Listener
from grader.report.model import Report
from grader.ros.distro import find_distro
from grader.sandbox.limits import Limits
from grader.sandbox.processes import adopt_orphans
from grader.verdict.mark import Order, grade
from tests import processes
from tests.corpus.broken import BROKEN
from tests.corpus.build import write
from tests.corpus.hostile import HOSTILE
from tests.corpus.model import Package
from tests.corpus.right import RIGHT

COURSE = processes.ROOT / "lab" / "course" / "hello_time"
ASSIGNMENT = load_assignment(COURSE / "assignment.yaml")
# a verdict takes two to four seconds: `make test` has every seventh package, `test-all` all
QUICK = 7
LIMITS = Limits().override({"build_seconds": 20, "start_seconds": 8, "run_seconds": 40})
PATIENCE = 120.0  # seconds within which the worst package must have its verdict


def mark(
    path: Path,
    *,
    distro: str = "jazzy",
    sandbox: str = "bubblewrap",
    listener: Listener = lambda event: None,
) -> Report:
    order = Order(
        path=path,
        assignment=ASSIGNMENT,
        distro=find_distro(distro),
        sandbox=sandbox,
        limits=LIMITS,
    )
    return grade(order, listener)


def packages(corpus: tuple[Package, ...], quick: int = QUICK) -> list[object]:
    """Return the parameters of a test over a corpus; all but each n-th are for `test-all`."""
    return [
        pytest.param(package, id=package.name, marks=() if k % quick == 0 else pytest.mark.full)
        for k, package in enumerate(corpus)
    ]


def summary(report: Report) -> str:
    """Return the summary of a report that a failing test shows."""
    rows = [
        f"{check.id}: {check.status} {[m.id for m in check.mistakes]} {check.actual[:300]}"
        for check in report.checks
        if check.status != "passed"
    ]
    return "\n".join([*rows, report.evidence.build_log[-1500:], report.evidence.transcript[-1500:]])


@pytest.mark.parametrize("package", packages(RIGHT))
def test_a_right_variant_gets_full_marks(package: Package, tmp_path: Path) -> None:
    report = mark(write(package, tmp_path))
    assert report.score == report.max_score == 100, summary(report)
    assert report.all_passed
    assert report.observed.clock == ("wall" if package.wall_clock else "virtual")


@pytest.mark.parametrize("package", packages(BROKEN))
def test_a_broken_package_fails_the_expected_checks_for_the_expected_reason(
    package: Package, tmp_path: Path
) -> None:
    verdict_is(package, mark(write(package, tmp_path)))


@pytest.mark.parametrize("package", packages(HOSTILE, 5))
def test_a_hostile_package_harms_nothing(package: Package, tmp_path: Path) -> None:
    adopt_orphans()
    before = set(processes.descendants())
    begin = time.monotonic()
    report = mark(write(package, tmp_path))
    assert time.monotonic() - begin < PATIENCE
    verdict_is(package, report)
    assert len(report.model_dump_json()) < 1_000_000
    left = {pid: line for pid, line in processes.descendants().items() if pid not in before}
    assert left == {}


def verdict_is(package: Package, report: Report) -> None:
    """Assert that a report has the verdict that the corpus expects for a package."""
    failed = {check.id for check in report.checks if check.status == "failed"}
    skipped = {check.id for check in report.checks if check.status == "skipped"}
    assert failed - package.undecided == set(package.expect_failed), summary(report)
    assert skipped - package.undecided == set(package.expect_skipped), summary(report)
    for check_id, mistake in package.expect_failed.items():
        check = report.check(check_id)
        assert check.expected, check_id
        assert check.actual, check_id
        assert check.rationale, check_id
        assert check.fix, check_id
        if mistake is not None:
            assert check.mistakes[0].id == mistake, check.actual
    for check in report.checks:
        assert check.status in ("passed", "failed", "skipped")
        assert (check.blocked_by in failed) == (check.status == "skipped")
    if package.expect_score is not None:
        assert report.score == package.expect_score
    assert report.score == sum(c.max_score for c in report.checks if c.status == "passed")


def test_the_solution_gets_full_marks_on_kilted_too(tmp_path: Path) -> None:
    report = mark(write(RIGHT[0], tmp_path), distro="kilted")
    assert report.score == 100, summary(report)
    assert report.environment.rclpy == "9.1.2"


@pytest.mark.full
def test_the_tutorials_own_node_gets_full_marks_on_kilted_too(tmp_path: Path) -> None:
    tutorial = next(package for package in RIGHT if package.name == "tutorial")
    report = mark(write(tutorial, tmp_path), distro="kilted")
    assert report.score == 100, summary(report)


def test_the_tutorials_traceback_is_advice_and_not_a_failure(tmp_path: Path) -> None:
    tutorial = next(package for package in RIGHT if package.name == "tutorial")
    report = mark(write(tutorial, tmp_path))
    assert report.score == 100
    assert "rcl_shutdown already called" in report.evidence.transcript
    assert report.observed.exit is not None
    assert report.observed.exit.status == 1
    assert "try_shutdown" in report.check("run.interrupt").advice[0]


def test_the_starter_does_not_get_full_marks(tmp_path: Path) -> None:
    report = mark(COURSE / "starter")
    assert report.score < 60
    assert report.status == "graded"


def test_the_period_is_measured_to_a_millisecond(tmp_path: Path) -> None:
    report = mark(write(RIGHT[0], tmp_path))
    assert [tick.virtual for tick in report.observed.ticks] == [float(k) for k in range(1, 11)]
    assert [tick.n for tick in report.observed.ticks] == list(range(10))
    stamps = [tick.wall for tick in report.observed.ticks]
    assert None not in stamps
    assert stamps == sorted(stamps, key=lambda stamp: stamp or 0)


def test_the_command_in_the_report_is_the_one_that_ran(tmp_path: Path) -> None:
    report = mark(write(RIGHT[0], tmp_path))
    assert report.observed.command == (
        "ros2 run my_robot_controller test_node --ros-args -p use_sim_time:=true"
    )
    assert report.observed.nodes == ["/my_first_node"]


@pytest.mark.parametrize("name", ["solution", "text_capital", "marker_missing", "spin_missing"])
def test_without_namespaces_the_verdict_is_the_same(name: str, tmp_path: Path) -> None:
    package = next(p for p in (*RIGHT, *BROKEN) if p.name == name)
    root = write(package, tmp_path)
    report = mark(root, sandbox="none")
    if package in RIGHT:
        assert report.score == 100, summary(report)
    else:
        verdict_is(package, report)
    assert report.environment.sandbox == "none"


@pytest.mark.full  # needs root, which `make test` does not
@pytest.mark.parametrize("name", ["solution", "period_half"])
def test_the_account_sandbox_gives_the_same_verdict(name: str, tmp_path: Path) -> None:
    package = next(p for p in (*RIGHT, *BROKEN) if p.name == name)
    root = write(package, tmp_path)
    command = processes.grader("grade", root, "--sandbox", "account", "--out", tmp_path / "out")
    done = processes.run(processes.as_root_of_a_container(command))
    assert done.returncode == (0 if package in RIGHT else 1), done.stdout + done.stderr
    (written,) = (tmp_path / "out").rglob("report.json")
    report = Report.model_validate(json.loads(written.read_text()))
    if package in RIGHT:
        assert report.score == 100, summary(report)
    else:
        verdict_is(package, report)
    assert report.environment.sandbox == "account"


def test_an_ordinary_user_gets_the_same_verdict(open_folder: Path) -> None:
    root = write(RIGHT[0], open_folder)
    done = processes.run(
        processes.as_user(processes.grader("grade", root, "--out", open_folder / "reports")),
        env={"HOME": str(open_folder), "GRADER_CACHE": str(cache_root())},
    )
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.fixture
def open_folder() -> Iterator[Path]:
    """A folder that every user may read and write; pytest's own are private."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        folder.chmod(0o777)
        yield folder
