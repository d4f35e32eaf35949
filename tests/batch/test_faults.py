"""A grader failure on one submission is reported for that student and does not end the run."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterable, Iterator
from pathlib import Path
from typing import Any

import pytest

from grader.base.errors import SurroundingsError
from grader.batch import intake, local_pool
from grader.batch.intake import take_in_class
from grader.batch.ledger import Ledger
from grader.batch.model import ClassFolder, HandedIn, Student
from grader.batch.result import class_result
from grader.batch.run import (
    FAULTS_IN_A_ROW,
    ClassPlan,
    Listener,
    MarkingSetting,
    carry_out,
    make_plan,
)
from grader.batch.sandbox_proof import prove
from grader.batch.systems.known import FOLDERS
from grader.batch.work import Answer, Done, Job, Task
from grader.course.assignment import Assignment
from grader.package.submission import Submission
from grader.publish.feedback import html_page
from grader.publish.gradebook_csv import gradebook_csv
from grader.ros.distro import find_distro
from grader.ros.prefix import Ros
from grader.run import probe_link
from grader.sandbox.base import Sandbox
from grader.sandbox.limits import Limits
from grader.verdict.take_in import take_in_for
from tests.batch.pool_tasks import JOB, package
from tests.marking import ASSIGNMENT
from tests.report.samples import report

SETTING = MarkingSetting(
    assignment=ASSIGNMENT,
    distro=find_distro("jazzy"),
    limits=Limits(),
    sandbox="bubblewrap",
    key="surroundings",
)
REASON = "tar: \x1b[31mCannot write: No space left on device"


class FailingPool:
    """A pool without workers that fails on the named students; `works` is its proof's result."""

    def __init__(self, *failing: str, works: bool = True) -> None:
        self.failing = failing
        self.works = works
        self.proofs = 0

    def run(
        self, tasks: Iterable[Task], *, started: Callable[[Task], None]
    ) -> Generator[Done, None, None]:
        for task in tasks:
            started(task)
            known = {"sha256": task.submission.sha256, "name": task.name, "path": "x"}
            verdict = report(submission={**report().submission.model_dump(), **known})
            failed = task.student in self.failing
            yield Done(task, Answer(fault=REASON) if failed else Answer(verdict))

    def prove(self) -> None:
        self.proofs += 1
        if not self.works:
            raise SurroundingsError("the sandbox does not open any more")


@pytest.fixture
def ledger(tmp_path: Path) -> Iterator[Ledger]:
    with Ledger(tmp_path / "ledger.sqlite") as opened:
        yield opened


def a_class(folder: Path, count: int) -> ClassFolder:
    """Write a class of `count` students: s0, s1, …"""
    names = [f"s{number}" for number in range(count)]
    handed_in = []
    for name in names:
        place = package("solution", folder, called=name)
        (place / "my_robot_controller" / "who.txt").write_text(name)
        handed_in.append(HandedIn(Student(name, name.upper()), place))
    return ClassFolder(FOLDERS, folder, tuple(handed_in))


def run(ledger: Ledger, folder: ClassFolder, pool: FailingPool) -> ClassPlan:
    plan = make_plan(ledger, folder, SETTING, listener=Listener())
    carry_out(ledger, plan, SETTING, pool, listener=Listener())
    return plan


def test_a_grader_failure_affects_one_student_and_the_class_goes_on(
    ledger: Ledger, tmp_path: Path
) -> None:
    folder, pool = a_class(tmp_path / "in", 3), FailingPool("s0")
    plan = run(ledger, folder, pool)
    assert pool.proofs == 1, "the sandbox works without it"
    result = class_result(ledger, folder, plan.items, ASSIGNMENT, distro="jazzy")
    assert [entry.status for entry in result.entries] == ["error", "graded", "graded"]
    failed = result.entries[0]
    assert failed.final is None
    assert "not your fault" in failed.problem
    assert REASON in failed.notes[0]
    assert "No space left on device" in gradebook_csv(result).decode("utf-8-sig")
    assert "No space left" not in html_page(failed, "x", show_hidden=True).decode()
    again = run(ledger, folder, FailingPool())
    assert len(again.todo) == 1, "the next run tries it again, and nothing else"
    result = class_result(ledger, folder, again.items, ASSIGNMENT, distro="jazzy")
    assert {entry.status for entry in result.entries} == {"graded"}


def test_the_run_ends_if_the_surroundings_fail_without_a_submission(
    ledger: Ledger, tmp_path: Path
) -> None:
    folder = a_class(tmp_path / "in", 2)
    with pytest.raises(SurroundingsError, match="does not open"):
        run(ledger, folder, FailingPool("s1", works=False))
    assert ledger.count() == 1, "what was reached is kept"


def test_several_failures_in_a_row_are_examined_before_the_next_submission(
    ledger: Ledger, tmp_path: Path
) -> None:
    folder = a_class(tmp_path / "in", FAULTS_IN_A_ROW + 1)
    failing = [f"s{number}" for number in range(FAULTS_IN_A_ROW)]
    with pytest.raises(SurroundingsError, match="does not open"):
        run(ledger, folder, FailingPool(*failing, works=False))
    assert ledger.count() == 0, "the one behind them was not tried"
    pool = FailingPool(*failing)
    run(ledger, folder, pool)
    assert pool.proofs == 2
    assert ledger.count() == 1


def test_a_class_without_a_single_verdict_is_a_grader_error(ledger: Ledger, tmp_path: Path) -> None:
    folder = a_class(tmp_path / "in", FAULTS_IN_A_ROW)
    with pytest.raises(SurroundingsError, match="on all 3 submissions"):
        run(ledger, folder, FailingPool("s0", "s1", "s2"))


def test_a_failure_on_a_single_submission_is_not_a_surroundings_error(
    ledger: Ledger, tmp_path: Path
) -> None:
    run(ledger, a_class(tmp_path / "in", 1), FailingPool("s0"))


def test_a_submission_that_intake_fails_on_stops_nobody_else(
    ledger: Ledger, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = a_class(tmp_path / "in", 3)

    def fails(assignment: Assignment, path: Path, **options: Any) -> Submission:
        if path.name == "s1":
            raise RecursionError("too deep")
        return take_in_for(assignment, path, **options)

    monkeypatch.setattr(intake, "take_in_for", fails)
    items = list(take_in_class(folder.handed_in, ASSIGNMENT, "key", seen=lambda _: None))
    assert [bool(item.key) for item in items] == [True, False, True]
    result = class_result(ledger, folder, items, ASSIGNMENT, distro="jazzy")
    assert [entry.status for entry in result.entries] == ["pending", "error", "pending"]
    assert "too deep" in result.entries[1].notes[0]


@pytest.mark.prefix
def test_the_proof_passes_if_the_surroundings_are_complete(ros_jazzy: Ros) -> None:
    prove(JOB)


@pytest.mark.prefix
def test_the_proof_fails_without_a_prefix_that_can_be_sourced(
    ros_jazzy: Ros, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Sandbox, "ros_path", "/nowhere")
    with pytest.raises(SurroundingsError, match="/nowhere"):
        prove(JOB)


@pytest.mark.prefix
def test_the_proof_fails_without_a_probe(
    ros_jazzy: Ros, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "probe.py").write_text("import rclpy_that_is_not_there")
    monkeypatch.setattr(probe_link, "SOURCE", tmp_path / "probe.py")
    with pytest.raises(SurroundingsError, match="rclpy_that_is_not_there"):
        prove(JOB)


def test_a_pool_proves_with_its_own_job(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[Job] = []
    monkeypatch.setattr(local_pool, "prove", asked.append)
    local_pool.LocalPool(JOB, 1).prove()
    assert asked == [JOB]
