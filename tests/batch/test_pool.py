"""The pool: real workers with real sandboxes, which crash, hang and are killed."""

from __future__ import annotations

import contextlib
import os
import signal
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from grader.batch.local_pool import LocalPool
from grader.batch.work import Done, Task
from grader.package.submission import take_in
from grader.package.submission_json import submission_from_json, submission_json
from grader.report.model import Report
from grader.ros.prefix import Ros
from tests.batch.pool_tasks import CORPUS, JOB, own_workers, tasks
from tests.marking import ASSIGNMENT
from tests.processes import descendants
from tests.report.samples import check, report

pytestmark = pytest.mark.prefix


def _ignore(task: Task) -> None:
    del task


def _score(done: Done) -> float:
    report = done.answer.report
    assert isinstance(report, Report), done.answer.fault
    return report.score


@pytest.mark.full
def test_each_student_gets_the_verdict_of_their_package(ros_jazzy: Ros, tmp_path: Path) -> None:
    names = ["empty_folder", "as_created", "entry_missing"]
    found = list(LocalPool(JOB, 2).run(tasks(tmp_path, names), started=_ignore))
    scores = {done.task.student: _score(done) for done in found}
    assert scores == {
        f"{name}-{number}": CORPUS[name].expect_score for number, name in enumerate(names)
    }
    assert {done.tries for done in found} == {1}
    assert own_workers() == []


@pytest.mark.long
def test_a_killed_worker_costs_nobody_a_verdict(ros_jazzy: Ros, tmp_path: Path) -> None:
    """Both workers are killed in the middle of a verdict and replaced."""
    killed: list[int] = []
    waiting = tasks(tmp_path, ["solution"] * 4)

    def submitted() -> Iterator[Task]:
        yield next(waiting)
        yield next(waiting)
        # both workers are busy now: a third task is only requested after one of them has ended
        for worker in own_workers():
            os.kill(worker, signal.SIGKILL)
            killed.append(worker)
        yield from waiting

    found = list(LocalPool(JOB, 3).run(submitted(), started=_ignore))
    assert [_score(done) for done in found] == [100] * 4
    assert len(killed) == 2
    assert sorted(done.tries for done in found) == [1, 1, 2, 2]
    assert _sandbox_processes() == {}


@pytest.mark.long  # (it waits for half a minute)
def test_a_hanging_worker_is_ended_and_the_submission_tried_again(
    ros_jazzy: Ros, tmp_path: Path
) -> None:
    stopped: list[int] = []
    waiting = tasks(tmp_path, ["as_created"] * 2)  # it takes two seconds

    def submitted() -> Iterator[Task]:
        yield next(waiting)
        (worker,) = own_workers()
        os.kill(worker, signal.SIGSTOP)
        stopped.append(worker)
        yield from waiting

    pool = LocalPool(JOB, 2, seconds=30)
    found = list(pool.run(submitted(), started=_ignore))
    assert [_score(done) for done in found] == [CORPUS["as_created"].expect_score] * 2
    tries = {done.task.student: done.tries for done in found}
    assert tries == {"as_created-0": 2, "as_created-1": 1}
    with pytest.raises(ProcessLookupError):
        os.kill(stopped[0], 0)
    assert _sandbox_processes() == {}


def test_a_worker_that_always_ends_is_a_grader_fault_for_each_submission(
    tmp_path: Path,
) -> None:
    """The command is not a worker at all; its last output is shown to the instructor."""
    command = (sys.executable, "-c", "import sys; sys.exit('no memory is left')")
    pool = LocalPool(JOB, 2, command=command)
    found = list(pool.run(tasks(tmp_path, ["solution"] * 3), started=_ignore))
    assert len(found) == 3
    assert {done.tries for done in found} == {3}
    assert all(done.answer.report is None for done in found)
    assert all("no memory is left" in done.answer.fault for done in found)


UNSURE = """
import json, os, sys, time
log, undecided, decided = sys.argv[1:4]
def note(text):
    with open(log, "a") as file:
        file.write(text + "\\n")
sys.stdin.readline()
for line in iter(sys.stdin.readline, ""):
    name = json.loads(line)["student"]
    first = f"begin {name}" not in open(log).read()
    note(f"begin {name}")
    time.sleep(0.05 if first else 0.2)
    note(f"end {name}")
    report = open(undecided if first and name.endswith(("0", "2")) else decided).read()
    answer = {"report": report, "fault": "", "seconds": 1, "recording": None}
    print(json.dumps(answer), flush=True)
"""


def test_what_is_undecided_is_tried_again_at_the_end_with_nothing_beside_it(tmp_path: Path) -> None:
    log, names = tmp_path / "log", ("undecided", "decided")
    log.touch()
    for name, status in zip(names, ("inconclusive", "passed")):
        text = report(check("run.period", status)).model_dump_json(by_alias=True)
        (tmp_path / name).write_text(text)
    command = (sys.executable, "-c", UNSURE, str(log), *(str(tmp_path / name) for name in names))
    pool = LocalPool(JOB, 2, command=command)
    found = list(pool.run(tasks(tmp_path, ["solution"] * 5), started=_ignore))
    again = ["solution-0", "solution-2"]
    assert {done.task.student for done in found if done.tries == 2} == set(again)
    assert all(done.answer.report and not done.answer.report.inconclusive for done in found)
    last = log.read_text().splitlines()[-4:]
    assert sorted(last[::2]) == [f"begin {name}" for name in again]
    assert [line.replace("begin", "end") for line in last[::2]] == last[1::2]


def test_an_invalid_answer_is_not_a_verdict(tmp_path: Path) -> None:
    command = (sys.executable, "-c", 'print(\'{"report": {"score": 100}}\', flush=True); input()')
    pool = LocalPool(JOB, 1, command=command)
    (done,) = pool.run(tasks(tmp_path, ["solution"]), started=_ignore)
    assert done.answer.report is None
    assert "sent an invalid answer" in done.answer.fault


@pytest.mark.full
def test_stopping_early_ends_every_worker_and_its_sandbox(ros_jazzy: Ros, tmp_path: Path) -> None:
    with contextlib.closing(
        LocalPool(JOB, 2).run(
            tasks(tmp_path, ["entry_missing", *["solution"] * 9]), started=_ignore
        )
    ) as running:
        next(running)
        assert own_workers()
    assert own_workers() == []
    assert _sandbox_processes() == {}


def test_a_submission_survives_serialisation(tmp_path: Path) -> None:
    (task,) = tasks(tmp_path, ["solution"])
    folder = tmp_path / "solution-0" / "my_robot_controller"
    (folder / "bytes.bin").write_bytes(bytes(range(256)) * 9)
    (folder / "link").symlink_to("setup.py")
    (folder / "empty").mkdir()
    (strange,) = _as_task(tmp_path)
    assert {file.path for file in strange.submission.files} > {"bytes.bin", "link", "empty"}
    for sent in (task, strange):
        assert submission_from_json(submission_json(sent.submission)) == sent.submission
        assert Task.from_text(sent.to_text()) == sent


def _as_task(folder: Path) -> list[Task]:
    place = next(folder.iterdir())
    found = take_in(place, package=ASSIGNMENT.package, node_file=ASSIGNMENT.node_file)
    return [Task("a", "b", "c", "d", found)]


def _sandbox_processes() -> dict[int, str]:
    """Return the descendants of this process that are a sandbox or run in one."""
    return {pid: line for pid, line in descendants().items() if "bwrap" in line or "ros" in line}
