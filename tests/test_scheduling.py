"""The time of a run stands still while one of its processes waits for a core of others."""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Callable, Iterator

import pytest

from grader.sandbox import scheduling
from grader.sandbox.scheduling import STRETCH, Limit, RunClock, family, own_family

SECONDS = 1.2
BURN = [sys.executable, "-c", "while True: pass"]
Start = Callable[[int], set[int]]


@pytest.fixture
def burning() -> Iterator[Start]:
    """A function that starts processes that keep a core busy, and returns their ids."""
    started: list[subprocess.Popen[bytes]] = []

    def start(count: int) -> set[int]:
        started.extend(subprocess.Popen(BURN) for _ in range(count))
        return {process.pid for process in started[-count:]}

    yield start
    for process in started:
        process.kill()
        process.wait()


def passed(clock: RunClock, seconds: float) -> float:
    """Return by how much a clock goes on in some seconds of wall time."""
    before, end = clock.now(at_once=True), time.monotonic() + seconds
    while time.monotonic() < end:
        clock.now()
        time.sleep(0.01)
    return clock.now(at_once=True) - before


def test_a_family_has_the_children_of_children() -> None:
    script = "import subprocess, time; subprocess.Popen(['sleep', '9']); print(flush=True); time.sleep(9)"
    with subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE) as child:
        assert child.stdout is not None
        child.stdout.readline()
        found = family(child.pid)
        assert len(found) == 2
        assert found < own_family()
        for pid in found:
            subprocess.run(["kill", str(pid)], check=True)


def test_it_stands_nearly_still_while_others_have_all_cores(burning: Start) -> None:
    run = burning(1)
    others = burning(8)
    clock = RunClock(lambda: run)
    assert not run & others
    wall = SECONDS
    assert passed(clock, wall) < 0.6 * wall


def test_waiting_for_cores_that_the_run_itself_has_is_its_own_time(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """As of a node with many busy threads: nobody else has the cores."""
    looks = Looks(monkeypatch)
    clock = RunClock(lambda: ())
    before = clock.now()
    looks.after(1.0, busy=2.0, ran=2.0, waited=6.0)
    assert clock.now(at_once=True) - before == pytest.approx(1.0, abs=0.03)
    before = clock.now()
    looks.after(1.0, busy=2.0, ran=0.5, waited=0.4)
    assert clock.now(at_once=True) - before == pytest.approx(0.6, abs=0.03)


def test_threads_that_compute_side_by_side_wait_at_the_same_time(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """As of two workers of a build that share a core, while others have the second one."""
    looks = Looks(monkeypatch)
    clock = RunClock(lambda: ())
    for _ in range(300):
        looks.after(0.02, busy=0.04, ran=0.02, waited=0.02)
        clock.now(at_once=True)
    before = clock.now(at_once=True)
    for _ in range(100):
        looks.after(0.02, busy=0.04, ran=0.02, waited=0.02)
        clock.now(at_once=True)
    assert clock.now(at_once=True) - before == pytest.approx(1.0, abs=0.05)


def test_a_wait_that_is_seen_when_it_is_over_is_made_up_for(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    looks = Looks(monkeypatch)
    clock = RunClock(lambda: ())
    before = clock.now()
    for _ in range(20):  # (each wait takes five looks)
        for waited in (0.0, 0.0, 0.0, 0.0, 0.09):
            looks.after(0.02, busy=0.04, ran=0.002, waited=waited)
            clock.now(at_once=True)
    assert clock.now(at_once=True) - before == pytest.approx(0.2, abs=0.1)


def test_a_limit_on_a_busy_machine_comes_to_an_end_that_proves_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    looks = Looks(monkeypatch)
    clock = RunClock(lambda: ())
    limit = clock.limit(1.0)
    for _ in range(int(STRETCH)):
        assert not limit.over
        looks.after(1.0, busy=2.0, ran=0.0, waited=1.0)
        clock.now(at_once=True)
    looks.after(1.0, busy=2.0, ran=0.0, waited=1.0)
    clock.now(at_once=True)
    assert limit.over
    assert clock.starved
    assert limit.name == "load"


def test_a_limit_that_decides_nothing_leaves_no_doubt(monkeypatch: pytest.MonkeyPatch) -> None:
    looks = Looks(monkeypatch)
    clock = RunClock(lambda: ())
    before = clock.fair
    limit = clock.limit(0.03, decides=False)
    looks.after(2.0, busy=4.0, ran=0.0, waited=2.0)
    assert limit.over
    assert limit.name == "load"
    assert not clock.starved
    assert clock.fair == pytest.approx(before, abs=0.01)


def test_a_limit_on_a_machine_with_free_cores_is_evidence(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    looks = Looks(monkeypatch)
    clock = RunClock(lambda: ())
    limit: Limit = clock.limit(1.0)
    looks.after(1.1, busy=0.1, ran=0.1, waited=0.05)
    clock.now(at_once=True)
    assert limit.over
    assert not clock.starved
    assert limit.name == "wall time"


class Looks:
    """What a clock sees of the machine; the wall clock is simulated too."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self._at, self._busy, self._ran, self._waited = 1000.0, 0.0, 0.0, 0.0
        monkeypatch.setattr(time, "monotonic", lambda: self._at)
        monkeypatch.setattr(RunClock, "_look", lambda _: self._seen())

    def after(self, seconds: float, *, busy: float, ran: float, waited: float) -> None:
        """Let time pass in which the machine was busy, and the run ran and waited (seconds)."""
        self._at += seconds
        self._busy += busy
        self._ran += ran
        self._waited += waited

    def _seen(self) -> scheduling._Look:
        threads = {(1, "1"): (round(self._ran * 1e9), round(self._waited * 1e9))}
        return scheduling._Look(self._at, self._busy, 0.0, threads)
