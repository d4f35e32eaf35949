"""A verdict has a total time limit, and is not retried after a student's limit was hit."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import cast

import pytest

from grader.base.unheard import unheard
from grader.batch.work import TRIES, Answer, Task, Trial
from grader.report.model import CheckResult, Mistake
from grader.run import session
from grader.run.observer import Event, Watch
from grader.run.probe_link import ProbeError, ProbeLink
from grader.run.run import Run, observe
from grader.run.session import Session, Unobserved
from grader.sandbox.base import Outcome, Sandbox
from grader.sandbox.limits import Limits
from grader.sandbox.scheduling import RunClock
from tests.batch.pool_tasks import tasks
from tests.corpus.build import write
from tests.corpus.hostile import HOSTILE
from tests.marking import ASSIGNMENT, assert_verdict, mark
from tests.report.samples import check, report

LIMITS = Limits()
LONG = Event("Hello time: 0", 0.0, 1.0, "logger", 0, None)


def test_the_ceiling_allows_a_build_and_two_runs_at_their_limits() -> None:
    for limits in (LIMITS, LIMITS.override({"build_seconds": 7, "start_seconds": 1})):
        run = limits.start_seconds + limits.run_seconds + limits.stop_seconds
        assert limits.verdict_seconds > limits.build_seconds + 2 * run


class Clock(RunClock):
    """The clock of a session with simulated runs; each run takes a given time."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, *results: Run | ProbeError) -> None:
        super().__init__(lambda: ())
        self.at = 1000.0
        self.runs = 0
        self.proofs: list[Sandbox] = []
        self.seconds: float | None = None  # of each run; None: until its time limit
        self._results = results
        monkeypatch.setattr(session, "observe", self._observe)
        monkeypatch.setattr(session, "ProbeLink", lambda sandbox: NoProbe())
        monkeypatch.setattr(session, "prove_again", self.proofs.append)

    def now(self, *, at_once: bool = False) -> float:
        return self.at

    def _observe(self, *args: object, until: float, fine: bool, **more: object) -> Run:
        result = self._results[min(self.runs, len(self._results) - 1)]
        self.runs += 1
        self.at = until if self.seconds is None else min(until, self.at + self.seconds)
        if isinstance(result, Run):
            return result
        raise result


class NoProbe:
    def close(self) -> None:
        return


class NoSandbox:
    limits = LIMITS

    def __init__(self, clock: Clock, *, works: bool) -> None:
        self.run_clock, self._works = clock, works

    def resource_limit_hit(self) -> str:
        return ""

    def held_by(self) -> dict[str, str]:
        return {}

    def run(self, argv: Sequence[str], *, seconds: float) -> Outcome:
        return Outcome(0 if self._works else 1, b"", seconds)


def new_session(clock: Clock, *, works: bool = True) -> Session:
    return Session(cast("Sandbox", NoSandbox(clock, works=works)), ASSIGNMENT)


def run_with_missing_ticks() -> Run:
    """Return a run with missing ticks, which requires a second run."""
    return Run("", Watch(clock="virtual", events=[LONG], missing=[1]), started=True)


def test_runs_at_their_time_limit_are_repeated_within_the_ceiling(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    clock = Clock(monkeypatch, ProbeError("no answer"))
    opened, begin = new_session(clock), clock.at
    with pytest.raises(Unobserved, match="no answer"):
        opened.run(unheard)
    assert clock.runs == 2
    assert clock.proofs == [opened.sandbox], "what failed may be ros2 itself"
    assert clock.at - begin <= LIMITS.verdict_seconds


def test_a_build_at_its_limit_leaves_time_for_a_second_run(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    first, second = run_with_missing_ticks(), run_with_missing_ticks()
    clock = Clock(monkeypatch, first, second)
    opened, begin = new_session(clock), clock.at
    clock.at += LIMITS.build_seconds
    assert opened.run(unheard) is first
    assert clock.runs == 2
    assert clock.at - begin <= LIMITS.verdict_seconds


def test_quick_grader_faults_are_tried_three_times(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = Clock(monkeypatch, ProbeError("it has ended"))
    clock.seconds = 1.0
    with pytest.raises(Unobserved, match="it has ended"):
        new_session(clock).run(unheard)
    assert clock.runs == 3


def test_no_run_starts_without_enough_time(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = Clock(monkeypatch, run_with_missing_ticks())
    opened = new_session(clock)
    clock.at += LIMITS.verdict_seconds - 1
    with pytest.raises(Unobserved, match="no time for a run"):
        opened.run(unheard)
    assert clock.runs == 0


ENDLESS = "trap '' INT TERM HUP; while :; do printf .; sleep 0.05; done"


@pytest.mark.prefix
@pytest.mark.parametrize(("overlay", "met"), [(ENDLESS, "wall time"), ("exit 0", "")])
def test_a_node_that_exceeds_a_limit_beside_a_silent_probe_is_blamed(
    make_sandbox: Callable[[Limits], Sandbox],
    monkeypatch: pytest.MonkeyPatch,
    overlay: str,
    met: str,
) -> None:
    """If the node has ended, the silent probe is our fault."""
    silent = "import time; print('{}', flush=True); time.sleep(100)"
    limits = Limits().override({"run_seconds": 0.5, "start_seconds": 0.5, "stop_seconds": 0.2})
    with make_sandbox(limits) as opened:
        opened.overlay = f"{overlay}; "  # (in place of `ros2 run`)
        probe = opened.probe
        monkeypatch.setattr(opened, "probe", lambda argv: probe(["python3", "-c", silent]))
        link = ProbeLink(opened)
        link.ready()
        begin = opened.run_clock.now()
        until = begin + 12  # of which ending the node may take ten
        if met:
            run = observe(opened, ASSIGNMENT, link, unheard, until=until)
            assert (run.resource, run.started) == (met, False)
        else:
            with pytest.raises(ProbeError, match="no answer"):
                observe(opened, ASSIGNMENT, link, unheard, until=until)
        assert opened.run_clock.now() - begin < 12
        link.close()


@pytest.mark.full
@pytest.mark.prefix
@pytest.mark.alone  # (its limits, measured in the time in which it had a core, are longer beside others)
def test_a_node_that_ignores_signals_and_prints_dots_has_a_quick_verdict(tmp_path: Path) -> None:
    package = next(package for package in HOSTILE if package.name == "deaf_and_prints_dots")
    begin = time.monotonic()
    found = mark(write(package, tmp_path))
    assert time.monotonic() - begin < 60
    assert found.timing.run < 30
    assert_verdict(package, found)


def answer(seconds: float, *changed: CheckResult) -> Answer:
    return Answer(report(*changed), seconds=seconds)


@pytest.fixture
def trial(tmp_path: Path) -> Trial:
    task: Task = next(tasks(tmp_path, ["solution"]))
    return Trial(task, most=100.0, tries=1)


UNKNOWN = check("run.period", "inconclusive")
MET = check("run.starts", "failed", mistakes=[Mistake(id="run.resource")])


def test_what_could_not_be_known_is_tried_again(trial: Trial) -> None:
    assert trial.add(answer(10, UNKNOWN)) is None
    trial.tries = TRIES
    done = trial.add(answer(10, UNKNOWN))
    assert done is not None
    assert done.answer.report is not None
    assert done.answer.report.attempts == TRIES


def test_a_submission_that_met_a_limit_of_its_own_is_never_tried_again(trial: Trial) -> None:
    assert trial.add(answer(10, UNKNOWN, MET)) is not None


def test_no_submission_is_tried_for_longer_than_two_ceilings(trial: Trial) -> None:
    assert trial.add(answer(90, UNKNOWN)) is None
    trial.tries = 2
    assert trial.add(answer(90, UNKNOWN)) is not None


def test_a_fault_without_an_answer_counts_as_well(trial: Trial) -> None:
    assert trial.add(Answer(fault="hung", seconds=100)) is None
    trial.tries = 2
    assert trial.add(Answer(fault="hung", seconds=100)) is not None
