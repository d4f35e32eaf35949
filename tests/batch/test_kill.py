"""Kill -9 of the coordinating process: the resumed ledger equals that of an undisturbed run."""

from __future__ import annotations

import random
import signal
import subprocess
import time
from pathlib import Path

import pytest

from grader.batch.ledger import Ledger
from grader.ros.prefix import Ros
from grader.sandbox.bubblewrap import Bubblewrap
from grader.sandbox.limits import Limits
from tests.batch.classes import corpus_class, grade_all
from tests.batch.pool_tasks import workers_of
from tests.processes import ROOT, alive, grader

pytestmark = pytest.mark.prefix

MIXED = ["solution", "entry_missing", "empty_folder", "text_capital", "str_missing"]
LONGEST = 4.0  # seconds until a kill: start-up and about two verdicts


def _verdicts(path: Path) -> dict[tuple[str, str], object]:
    """Return what must be equal in two verdicts: statuses, scores and mistake ids."""
    found: dict[tuple[str, str], object] = {}
    with Ledger(path) as ledger:
        rows = ledger.verdicts()
        assert ledger.count() == len(rows), "somebody has two verdicts"
        for pair, row in rows.items():
            report = ledger.report(row.id)
            checks = [(c.id, c.status, c.score, [m.id for m in c.mistakes]) for c in report.checks]
            found[pair] = (report.status, report.score, checks)
    return found


def _killed_after(folder: Path, out: Path, seconds: float) -> None:
    """Start the command and kill it after `seconds`; its workers end with it."""
    command = grader("grade-all", folder, "--out", out, "--sandbox", "bubblewrap", "-q")
    with subprocess.Popen(
        command, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    ) as process:
        try:
            process.wait(timeout=seconds)
        except subprocess.TimeoutExpired:
            workers = workers_of(process.pid)
            process.send_signal(signal.SIGKILL)
            process.wait()
            _wait_for_the_end(workers)


def _wait_for_the_end(workers: list[int]) -> None:
    until = time.monotonic() + 10
    while any(Path(f"/proc/{worker}/exe").exists() for worker in workers):
        assert time.monotonic() < until, "a worker lives on"
        time.sleep(0.01)


def _compare(ros: Ros, tmp_path: Path, students: int, kills: int, seed: int) -> None:
    print(f"seed {seed}")
    chance = random.Random(seed)
    names = [MIXED[number % len(MIXED)] for number in range(students)]
    folder = corpus_class(tmp_path / "class", names)
    undisturbed = grade_all(folder, tmp_path / "calm", "-q")
    assert undisturbed.returncode == 1, undisturbed.stderr
    for _ in range(kills):
        _killed_after(folder, tmp_path / "shaken", chance.uniform(0.1, LONGEST))
    again = grade_all(folder, tmp_path / "shaken", "-q")
    assert again.returncode == 1, again.stderr
    found = _verdicts(tmp_path / "shaken" / "ledger.sqlite")
    assert found == _verdicts(tmp_path / "calm" / "ledger.sqlite")
    assert len(found) == students
    with Bubblewrap(ros, Limits()):  # the next run removes what was left
        pass
    assert not alive(str(tmp_path)), "something of it still runs"


@pytest.mark.long  # (an interrupted run that resumes, in test_grade_all.py, is in .ci/run)
def test_killing_the_coordinator_loses_no_verdict(ros_jazzy: Ros, tmp_path: Path) -> None:
    _compare(ros_jazzy, tmp_path, students=2, kills=2, seed=random.randrange(10**6))


@pytest.mark.long
def test_twenty_kills_at_random_moments_change_no_verdict(ros_jazzy: Ros, tmp_path: Path) -> None:
    _compare(ros_jazzy, tmp_path, students=30, kills=20, seed=random.randrange(10**6))
