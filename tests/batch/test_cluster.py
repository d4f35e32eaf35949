"""A real Dask scheduler with real worker processes, some of which are killed or unusable."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path
from threading import Timer
from typing import TYPE_CHECKING

import pytest

from grader.base.errors import SurroundingsError
from grader.base.unheard import unheard
from grader.batch.cluster import Cluster
from grader.batch.ledger import Ledger
from grader.batch.work import Done, Task
from grader.ros.prefix import Ros
from tests.batch.classes import corpus_class, count_verdicts, grade_all
from tests.batch.pool_tasks import CORPUS, JOB, tasks
from tests.processes import ROOT, grader

if TYPE_CHECKING:
    from distributed import Future

pytestmark = [pytest.mark.prefix, pytest.mark.full]


@contextmanager
def process(
    *words: str, ready: str, env: dict[str, str] | None = None
) -> Iterator[tuple[int, str]]:
    """Start a Dask program; yield its process id and the line that announces it is ready."""
    with subprocess.Popen(
        [sys.executable, "-m", "distributed.cli." + words[0], *words[1:]],
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(ROOT), **(env or {})},
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    ) as started:
        assert started.stderr is not None
        output = ""
        for line in started.stderr:
            output += line
            if ready in line:
                break
        else:
            raise AssertionError(output)
        try:
            yield started.pid, line.split()[-1]
        finally:
            os.killpg(started.pid, signal.SIGKILL)


SCHEDULER = ("dask_scheduler", "--port", "0", "--no-dashboard", "--host", "127.0.0.1")


@contextmanager
def scheduler_and_worker() -> Iterator[tuple[int, str]]:
    """Start both; yield the scheduler's process id and its address."""
    with process(*SCHEDULER, ready="Scheduler at:") as (scheduler, address):
        worker = ("dask_worker", address, "--nthreads", "1", "--no-dashboard", "--no-nanny")
        with process(*worker, ready="Registered to:"):
            yield scheduler, address


@pytest.fixture
def scheduler() -> Iterator[str]:
    with process(*SCHEDULER, ready="Scheduler at:") as (_, address):
        yield address


@pytest.fixture
def start_worker(scheduler: str, tmp_path: Path) -> Iterator[Callable[..., int]]:
    with ExitStack() as stack:

        def start(**env: str) -> int:
            words = ["dask_worker", scheduler, "--nthreads", "1", "--no-dashboard", "--no-nanny"]
            words += ["--local-directory", str(tmp_path / "dask"), "--host", "127.0.0.1"]
            pid, _ = stack.enter_context(process(*words, ready="Registered to:", env=env))
            return pid

        yield start


def _ignore(task: Task) -> None:
    del task


def _scores(done: list[Done]) -> dict[str, float]:
    found = {}
    for one in done:
        assert one.answer.report is not None, one.answer.fault
        found[one.task.student] = one.answer.report.score
    return found


@pytest.mark.long
def test_a_lost_worker_costs_only_the_submission_it_was_marking(
    ros_jazzy: Ros, scheduler: str, start_worker: Callable[..., int], tmp_path: Path
) -> None:
    first = start_worker()
    start_worker()
    names = ["solution", "entry_missing"] * 2
    with Cluster(scheduler, JOB, notify=print) as cluster:
        found: list[Done] = []
        for done in cluster.run(tasks(tmp_path, names), started=_ignore):
            found.append(done)
            if len(found) == 1:
                os.kill(first, signal.SIGKILL)
    expected = {f"{name}-{n}": CORPUS[name].expect_score for n, name in enumerate(names)}
    assert _scores(found) == expected


def test_a_scheduler_that_ends_during_the_wait_is_reported(
    ros_jazzy: Ros, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with (
        scheduler_and_worker() as (scheduler, address),
        Cluster(address, JOB, notify=print) as cluster,
    ):
        wait = cluster._wait

        def waits(futures: list[Future[str]]) -> list[Future[str]]:
            # a verdict takes seconds, so this is in the middle of the wait
            Timer(0.2, os.kill, (scheduler, signal.SIGKILL)).start()
            return wait(futures)

        monkeypatch.setattr(cluster, "_wait", waits)
        with pytest.raises(SurroundingsError, match="is gone"):
            list(cluster.run(tasks(tmp_path, ["solution"]), started=_ignore))


@pytest.mark.long
def test_no_verdict_is_lost_if_the_scheduler_ends(ros_jazzy: Ros, tmp_path: Path) -> None:
    folder = corpus_class(tmp_path / "class", ["solution", "entry_missing", "solution"])
    with scheduler_and_worker() as (scheduler, address):
        command = grader("grade-all", folder, "--out", tmp_path / "out", "--scheduler", address)
        with subprocess.Popen(
            [*command, "--quiet"], cwd=ROOT, stderr=subprocess.PIPE, text=True
        ) as begun:
            assert begun.stderr is not None
            while not count_verdicts(tmp_path / "out" / "ledger.sqlite"):
                assert begun.poll() is None
                time.sleep(0.02)
            os.kill(scheduler, signal.SIGKILL)
            _, output = begun.communicate(timeout=120)
    assert begun.returncode == 3, output
    assert "is gone" in output
    assert "Traceback" not in output
    again = grade_all(folder, tmp_path / "out")
    assert again.returncode == 1, again.stderr
    with Ledger(tmp_path / "out" / "ledger.sqlite") as ledger:
        assert ledger.count() == 3


@pytest.mark.long
def test_verdicts_from_the_cluster_are_kept_in_the_local_ledger(
    ros_jazzy: Ros, scheduler: str, start_worker: Callable[..., int], tmp_path: Path
) -> None:
    start_worker()
    folder = corpus_class(tmp_path / "class", ["solution", "entry_missing"])
    done = grade_all(folder, tmp_path / "out", "--scheduler", scheduler)
    assert done.returncode == 1, done.stderr
    assert "marks in bubblewrap" in done.stderr
    # what the cluster has marked is not marked again on this machine
    again = grade_all(folder, tmp_path / "out")
    assert "0 to mark, 2 marked before" in again.stderr
    with Ledger(tmp_path / "out" / "ledger.sqlite") as ledger:
        assert ledger.count() == 2


def test_a_worker_without_a_sandbox_is_not_used(
    ros_jazzy: Ros, scheduler: str, start_worker: Callable[..., int], tmp_path: Path
) -> None:
    start_worker()
    start_worker(PATH="/nowhere")
    messages: list[str] = []
    with Cluster(scheduler, JOB, notify=messages.append) as cluster:
        (done,) = cluster.run(tasks(tmp_path, ["solution"]), started=unheard)
    assert _scores([done]) == {"solution-0": 100}
    assert len([line for line in messages if "marks in bubblewrap" in line]) == 1
    assert len([line for line in messages if "is not used" in line]) == 1


def test_a_cluster_without_a_usable_worker_is_refused(
    scheduler: str, start_worker: Callable[..., int]
) -> None:
    start_worker()
    job = replace(JOB, distro="lyrical")
    with pytest.raises(SurroundingsError, match="no worker"), Cluster(scheduler, job, notify=print):
        pass


@pytest.mark.long
def test_an_unreachable_scheduler_is_reported(tmp_path: Path) -> None:
    folder = corpus_class(tmp_path / "class", ["solution"])
    done = grade_all(folder, tmp_path / "out", "--scheduler", "tcp://127.0.0.1:9")
    assert done.returncode == 3
    assert "does not answer" in done.stderr
    assert "Traceback" not in done.stderr
