"""When a session runs the node again, and what it makes of two runs (the runs are simulated)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import cast

import pytest

from grader.base.unheard import unheard
from grader.run import session
from grader.run.observer import Event, Watch
from grader.run.probe_link import NodeSeen
from grader.run.run import Run
from grader.run.session import Session
from grader.run.unforeseen import Unforeseen
from grader.sandbox.base import Outcome, Sandbox
from grader.sandbox.limits import Limits
from grader.sandbox.scheduling import RunClock
from tests.marking import ASSIGNMENT


class NoSandbox:
    limits = Limits()
    held = "cgroup"

    def __init__(self) -> None:
        self.run_clock = RunClock()

    def held_by(self) -> dict[str, str]:
        return {"memory": self.held, "processes": self.held}

    def resource_limit_hit(self) -> str:
        return ""

    def run(self, argv: list[str], *, seconds: float) -> Outcome:
        return Outcome(0, b"", seconds)


class NoProbe:
    def close(self) -> None:
        return


def right_run(held: float = 0.02) -> Run:
    """Return a run on virtual time with eleven lines, each step held up for some seconds."""
    events = [Event(f"Hello time: {n}", n, n + 1, "logger", n, n) for n in range(11)]
    watch = Watch(clock="virtual", events=events, held=[held] * 10)
    node = NodeSeen("/my_first_node", clock=True, rosout=True, parameters=True)
    return Run("ros2 run", watch, nodes=(node,), started=True)


@pytest.fixture
def runs(monkeypatch: pytest.MonkeyPatch) -> Callable[..., Session]:
    """A function that makes a session whose runs and plain runs have given results."""

    def make(*results: Run, plain: tuple[bool, ...] = ()) -> Session:
        left, plainly = iter(results), iter(plain)

        monkeypatch.setattr(session, "observe", lambda *_, **__: next(left))
        monkeypatch.setattr(session, "counts_plainly", lambda *_, **__: next(plainly))
        monkeypatch.setattr(session, "ProbeLink", lambda _: NoProbe())
        return Session(cast("Sandbox", NoSandbox()), ASSIGNMENT)

    return make


def test_a_right_run_is_enough(runs: Callable[..., Session]) -> None:
    first = right_run()
    assert runs(first).run(unheard) is first
    assert (first.held_up, first.confirmed) == (0, None)


def test_callbacks_that_hold_up_two_runs_are_slow(runs: Callable[..., Session]) -> None:
    run = runs(right_run(held=1.8), right_run(held=1.9)).run(unheard)
    assert run.held_up == pytest.approx(1.85)


def test_a_run_that_was_held_up_once_proves_nothing(runs: Callable[..., Session]) -> None:
    second = right_run()
    assert runs(right_run(held=1.8), second).run(unheard) is second
    assert second.held_up == 0


def test_two_slow_steps_prove_nothing(runs: Callable[..., Session]) -> None:
    first = right_run()
    first.watch.held[:2] = [5.0, 5.0]
    assert runs(first).run(unheard) is first


@pytest.mark.parametrize(
    ("plain", "confirmed"),
    [
        ((True,), True),
        ((False, True), True),
        ((False, False), False),
    ],
)
def test_only_two_plain_runs_without_a_count_blame_the_node(
    runs: Callable[..., Session], plain: tuple[bool, ...], confirmed: bool
) -> None:
    opened = runs(right_run(), plain=plain)
    opened._could_tell = True
    assert opened.run(unheard).confirmed is confirmed


@pytest.mark.parametrize(
    ("confirm", "could_tell", "draw", "made"),
    [
        ("sample", False, 0.5, False),
        ("sample", False, 0.01, True),
        ("sample", True, 0.5, True),
        ("never", True, 0.01, False),
        ("always", False, 0.5, True),
    ],
)
def test_who_is_run_plainly(
    runs: Callable[..., Session], confirm: str, could_tell: bool, draw: float, made: bool
) -> None:
    opened = runs(right_run(), plain=(True,))
    opened.assignment = ASSIGNMENT.model_copy(update={"confirm": confirm})
    opened._could_tell = could_tell
    opened._unforeseen = Unforeseen(more_ticks=1, stay_seconds=0, draw=draw)
    assert opened.run(unheard).confirmed is (True if made else None)


def died(*, counted: int = 0) -> Run:
    """Return a run whose program ended by itself after some lines."""
    run = right_run()
    run.watch.events[counted:] = []
    run.ended_by_itself = True
    return run


@pytest.mark.parametrize(
    ("first", "second", "taken"),
    [
        pytest.param(right_run(), None, 0, id="it counts with the arguments"),
        pytest.param(died(), right_run(), 1, id="the arguments stop it"),
        pytest.param(
            died(), died(), 1, id="it dies without them too, with the error a person sees"
        ),
        pytest.param(died(counted=5), right_run(), 1, id="it ends with them only"),
        pytest.param(died(counted=5), died(counted=5), 0, id="it ends with and without them"),
    ],
)
def test_a_program_that_reads_its_command_line_is_run_without_arguments(
    runs: Callable[..., Session], first: Run, second: Run | None, taken: int
) -> None:
    made = [first, *([] if second is None else [second])]
    opened = runs(*made)
    opened._reads_command_line = True
    assert opened.run(unheard) is made[taken]


def test_a_program_that_does_not_read_it_is_not(runs: Callable[..., Session]) -> None:
    first = died()
    assert runs(first).run(unheard) is first


@pytest.mark.parametrize(
    ("error", "limit"),
    [
        ("MemoryError", "memory"),
        ("RuntimeError: Resource temporarily unavailable", "processes"),
        ("RuntimeError: can't start new thread", "processes"),
        ("ValueError: no", ""),
    ],
)
@pytest.mark.parametrize("held", ["rlimit", "cgroup"])
def test_a_node_that_dies_of_a_limit_on_each_process_met_that_limit(
    runs: Callable[..., Session], error: str, limit: str, held: str
) -> None:
    """As where a control group holds the limit, so that both verdicts are the same."""
    ended = Run("ros2 run", ended_by_itself=True, transcript=f"Traceback ...\n{error}\n")
    opened = runs(ended)
    cast("NoSandbox", opened.sandbox).held = held
    assert opened.run(unheard).resource == (limit if held == "rlimit" else "")


def test_a_node_that_already_failed_is_not_run_plainly(runs: Callable[..., Session]) -> None:
    """Its count would be as wrong there, and it would be blamed for that as well."""
    ended, wrong = right_run(), right_run()
    ended.ended_by_itself = True
    wrong.watch.events[:] = [replace(event, n=0) for event in wrong.watch.events]
    for first in (ended, wrong):
        opened = runs(first)
        opened._could_tell = True
        assert opened.run(unheard).confirmed is None
