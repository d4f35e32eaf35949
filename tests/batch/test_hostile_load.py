"""Eight hostile and eight honest students at once: the honest ones get the verdict they deserve."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.batch.ledger import Ledger
from grader.ros.prefix import Ros
from tests import processes
from tests.batch.classes import corpus_class, grade_all
from tests.batch.pool_tasks import CORPUS
from tests.corpus.build import write
from tests.corpus.hostile import HOSTILE
from tests.marking import assert_verdict

pytestmark = [pytest.mark.prefix, pytest.mark.long]

ATTACKS = {
    "eats_memory",
    "fork_bomb",
    "one_endless_line",
    "records_at_full_speed",
    "setup_fork_bomb",
    "setup_prints_megabytes",
    "takes_all_terminals",
    "threads_without_end",
}
HONEST = (
    *("solution", "reentrant_on_threads", "stranger_eight_publishers", "stranger_asyncio_main"),
    *("stranger_slow_but_legal_callback", "period_half", "spin_missing", "entry_missing"),
)


def test_honest_students_beside_hostile_ones_lose_nothing(ros_jazzy: Ros, tmp_path: Path) -> None:
    before = set(processes.descendants())
    folder = corpus_class(tmp_path / "class", HONEST)
    hostile = [package for package in HOSTILE if package.name in ATTACKS]
    assert len(hostile) == len(HONEST) == 8
    for package in hostile:
        place = folder / package.name
        place.mkdir()
        write(package, place).rename(place / "my_robot_controller")
    out = tmp_path / "out"
    done = grade_all(folder, out, "-q", "--workers", "16", timeout=1800)
    assert done.returncode == 1, done.stderr
    with Ledger(out / "ledger.sqlite") as ledger:
        reports = {
            student: ledger.report(row.id) for (student, _), row in ledger.verdicts().items()
        }
    assert len(reports) == 16
    for number, name in enumerate(HONEST):
        assert_verdict(CORPUS[name], reports[f"s{number}-{name}"])
    for package in hostile:
        assert_verdict(package, reports[package.name])
    processes.wait_until_gone(before)
