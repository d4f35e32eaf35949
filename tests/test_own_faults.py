"""Faults of our own side: a full disk, no memory, a clock set back, a held ledger, signals."""

from __future__ import annotations

import contextlib
import os
import shlex
import signal
import sqlite3
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from grader.base.errors import SurroundingsError
from grader.batch import ledger_file
from grader.batch.ledger import Ledger
from grader.batch.local_pool import START_WORKER, LocalPool
from grader.package.submission import SourceFile
from grader.report.events import Event, TickSeen
from grader.sandbox.processes import adopt_orphans
from tests import processes
from tests.batch import stub_run
from tests.batch.pool_tasks import CORPUS, JOB, tasks
from tests.corpus.build import write
from tests.marking import assert_full_marks, mark
from tests.report.samples import check, report

STAGES = ("opening the sandbox", "building with colcon", "running the node")


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A file system of half a megabyte; `mount -o remount,size=…` makes it larger."""
    place = tmp_path / "disk"
    place.mkdir()
    subprocess.run(["mount", "-t", "tmpfs", "-o", "size=500k", "tmpfs", place], check=True)
    yield place
    subprocess.run(["umount", place], check=True)


def scored_class(folder: Path, count: int) -> Path:
    """Write a class for `stub_run`: each node states its score."""
    for number in range(count):
        root = write(CORPUS["solution"], folder / f"s{number:02}")
        node = root / "my_robot_controller" / "my_first_node.py"
        node.write_text(f"{node.read_text()}# score: {50 + number}\n")
    return folder


@pytest.mark.full
def test_a_full_disk_loses_no_verdict_and_the_same_command_goes_on(
    small_disk: Path, tmp_path: Path
) -> None:
    folder = scored_class(tmp_path / "class", 30)
    first = stub_run.grade_all(folder, small_disk / "out")
    assert first.status == 3, first.output
    assert "Traceback" not in first.output
    ledger = small_disk / "out" / "ledger.sqlite"
    kept = 0
    if ledger.exists():
        with contextlib.suppress(SurroundingsError), Ledger(ledger) as opened:
            kept = opened.count()
    subprocess.run(["mount", "-o", "remount,size=100m", small_disk], check=True)
    again = stub_run.grade_all(folder, small_disk / "out")
    assert again.status == 1, again.output
    assert again.marked == 30 - kept, "what was recorded is not marked again"
    assert sorted(map(float, again.finals().values())) == [50.0 + n for n in range(30)]
    with Ledger(ledger) as opened:
        assert opened.count() == 30
        assert opened.check_chain(None).faults == []


@pytest.mark.long
@pytest.mark.prefix
def test_a_worker_without_memory_costs_only_its_own_submission(tmp_path: Path) -> None:
    one, two = tasks(tmp_path, ["solution", "entry_missing"])
    big = SourceFile("big.bin", "file", 0o644, b"x" * 120_000_000)
    large = replace(one.submission, files=(*one.submission.files, big))
    limited = "ulimit -S -v 700000; exec " + shlex.join([sys.executable, "-c", START_WORKER])
    pool = LocalPool(JOB, 1, command=("bash", "-c", f'{limited} "$0"'))
    found = {
        done.task.student: done.answer
        for done in pool.run(iter([replace(one, submission=large), two]), started=lambda _: None)
    }
    lost, other = found["solution-0"], found["entry_missing-1"]
    assert lost.report is None
    assert "MemoryError" in lost.fault or "crashed" in lost.fault
    assert other.report is not None
    assert other.report.score == CORPUS["entry_missing"].expect_score


@pytest.mark.full
@pytest.mark.prefix
def test_a_clock_that_is_set_back_while_a_node_is_marked_costs_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    real = time.time
    set_back = False
    read: list[float] = []

    def shifted() -> float:
        if not set_back:
            return real()
        read.append(real() - 3600)
        return read[-1]

    def listener(event: Event) -> None:
        nonlocal set_back
        set_back = set_back or isinstance(event, TickSeen)

    monkeypatch.setattr(time, "time", shifted)
    package = CORPUS["solution"]
    assert_full_marks(package, mark(write(package, tmp_path), listener=listener))
    assert read, "nothing read the clock after it was set back"


def test_verdicts_from_before_and_after_a_clock_was_set_back_count_in_their_order(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "ledger.sqlite"
    with Ledger(path) as ledger:
        ledger.record("kim", "k1", report())
        ledger.request_regrades(ledger.verdicts().values())
        monkeypatch.setattr("grader.batch.ledger._now", lambda: "2020-01-01T00:00:00+00:00")
        ledger.record("kim", "k1", report(check("run.output", "failed")))
        assert ledger.verdicts()["kim", "k1"].score == 90
        assert ledger.check_chain(None).faults == []


def test_a_ledger_that_another_program_holds_is_said_and_nothing_is_lost(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ledger_file, "BUSY_SECONDS", 0.1)
    path = tmp_path / "ledger.sqlite"
    with Ledger(path) as ledger:
        ledger.record("kim", "k1", report())
        other = sqlite3.connect(path, isolation_level=None)
        other.execute("BEGIN IMMEDIATE")
        with pytest.raises(SurroundingsError, match="locked"):
            ledger.record("lee", "k1", report())
        other.execute("ROLLBACK")
        other.close()
        ledger.record("lee", "k1", report())
        assert ledger.count() == 2
        assert ledger.check_chain(None).faults == []


@pytest.mark.full
@pytest.mark.prefix
@pytest.mark.parametrize(
    "stage", [*(pytest.param(s, marks=pytest.mark.long) for s in STAGES[:-1]), STAGES[-1]]
)
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGKILL], ids=["TERM", "KILL"])
def test_a_grader_that_ends_in_any_stage_leaves_nothing_and_no_half_report(
    stage: str, number: signal.Signals, tmp_path: Path
) -> None:
    adopt_orphans()
    before = set(processes.descendants())
    root = write(CORPUS["solution"], tmp_path / "kim")
    command = processes.grader("grade", root, "--out", tmp_path / "out", "--sandbox", "bubblewrap")
    with subprocess.Popen(
        command,
        cwd=processes.ROOT,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        env=os.environ | {"LC_ALL": "C.UTF-8"},
        text=True,
    ) as running:
        assert running.stderr is not None
        for line in running.stderr:
            if stage in line:
                running.send_signal(number)
                break
        else:
            pytest.fail(f"there was no stage {stage!r}")
        rest = running.stderr.read()
    expected = 143 if number == signal.SIGTERM else -signal.SIGKILL
    assert running.returncode == expected, rest
    assert "Traceback" not in rest
    processes.wait_until_gone(before)
    assert not list((tmp_path / "out").rglob("report.json"))
