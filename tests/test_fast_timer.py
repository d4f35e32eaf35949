"""A node with a timer that is faster than the steps of the clock: no tick of it may be lost."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace

import pytest

from grader.base.unheard import unheard
from grader.package.intake.model import SourceFile
from grader.package.source.timer_periods import TimerPeriods, timer_periods
from grader.run import session
from grader.run.clock import GRID, VirtualClock
from grader.run.observer import SECOND, Observer, Watch
from grader.run.probe_link import Answer
from grader.run.run import Run
from grader.run.session import FASTEST, Session
from grader.run.terminal import Terminal
from tests.test_clock import OUTPUT, Node, SlowConsole
from tests.test_session import right_run, runs  # noqa: F401 - the second is a fixture

NODE = "my_robot_controller/my_first_node.py"


class EveryNth(Node):
    """A node with a fast timer that logs at each n-th call; after a jump the timer runs once."""

    def __init__(self, console: SlowConsole, period: float, every: int) -> None:
        super().__init__(console)
        self._fast, self._every, self._calls = round(period * SECOND), every, 0
        self._due = self._fast

    def ask(self, do: str, *, seconds: float = 0, **more: int | str) -> Answer:
        if do != "clock" or int(more["at"]) < self._due:
            return Answer(barrier=True, logs=())
        self._due = int(more["at"]) // self._fast * self._fast + self._fast
        self._calls += 1
        logs = () if self._calls % self._every else (self._log(),)
        return Answer(barrier=True, logs=logs)


def driven(
    period: float, every: int, grid: float, *, fine: bool = True, fine_ticks: int = 0
) -> Watch:
    console = SlowConsole()
    observer = Observer(Terminal(console, most=1_000_000), EveryNth(console, period, every), OUTPUT)
    watch = Watch()
    clock = VirtualClock(
        observer,
        OUTPUT,
        deadline=time.monotonic() + 30,
        fine=fine,
        grid=grid,
        fine_ticks=fine_ticks,
    )
    clock.drive(watch, lambda event: None)
    return watch


@pytest.mark.parametrize(("period", "every"), [(0.01, 100), (0.02, 50)])
def test_a_right_node_with_a_fast_timer_is_on_time(period: float, every: int) -> None:
    watch = driven(period, every, OUTPUT.period / period)
    assert not watch.missing
    assert not watch.early
    assert len(watch.dues) == OUTPUT.ticks


@pytest.mark.full
def test_a_jump_of_the_clock_makes_a_wrong_node_look_right() -> None:
    """At 0.2 s: calls 2, 4, …; but with one jump to each line, call 2 comes at 1 s."""
    assert not driven(0.1, 2, GRID, fine=False).early
    assert driven(0.1, 2, GRID, fine=False, fine_ticks=2).early
    assert driven(0.1, 2, GRID).period == pytest.approx(0.2)


@pytest.mark.full
@pytest.mark.parametrize("period", [0.009, 0.02, 0.05])
def test_a_period_below_the_steps_is_measured_in_milliseconds(period: float) -> None:
    assert driven(period, 1, GRID, fine=False).period == pytest.approx(period)


@pytest.mark.full
def test_larger_steps_than_the_timer_has_lose_ticks() -> None:
    assert driven(0.01, 100, GRID).missing


@pytest.mark.full
@pytest.mark.parametrize(("period", "every"), [(0.03, 10), (0.01, 10)])
def test_the_period_of_a_wrong_node_is_measured(period: float, every: int) -> None:
    watch = driven(period, every, OUTPUT.period / period)
    assert watch.period == pytest.approx(period * every)


@pytest.mark.parametrize(
    ("text", "seconds"),
    [
        ("self.create_timer(0.01, self.tick)", 0.01),
        ("self.create_timer(1.0, self.tick)\nself.create_timer(0.05, self.fast)", 0.05),
        ("self.create_timer(timer_period_sec=1 / 200, callback=self.tick)", 0.005),
        ("RATE = 100\nself.create_timer(1 / RATE, self.tick)", 0.01),
        ("self.hz = 50.0\nself.period = 1 / self.hz\nnode.create_timer(self.period, f)", 0.02),
        ("RATE = 100\nRATE = 200\nself.create_timer(1 / RATE, self.tick)", None),
        ("X = X\nself.create_timer(X, self.tick)", None),
        ("self.create_timer(1 / 0, self.tick)", None),
        ("self.create_timer(0, self.tick)", None),
        ("self.create_timer(period(), self.tick)", None),
        ("self.create_timer()", None),
        ("self.create_rate(10)", 0.1),
        ("self.create_rate(frequency=4.0, clock=None)", 0.25),
        ("self.create_rate(0)", None),
        ("self.create_rate()", None),
        ("print(", None),
    ],
)
def test_the_source_says_the_shortest_period(text: str, seconds: float | None) -> None:
    found = timer_periods([SourceFile(NODE, "file", data=text.encode())]).fastest
    assert found == (None if seconds is None else pytest.approx(seconds))


def test_a_period_can_be_in_another_module() -> None:
    files = [
        SourceFile(NODE, "file", data=b"self.create_timer(config.PERIOD, self.tick)\n"),
        SourceFile("my_robot_controller/config.py", "file", data=b"PERIOD = 0.01\n"),
    ]
    assert timer_periods(files).fastest == pytest.approx(0.01)


@pytest.mark.parametrize(
    ("text", "known"),
    [
        ("self.create_timer(1.0, self.tick)", True),
        ("self.create_timer(PERIOD, self.tick)", False),
        ("self.create_timer(1.0, self.tick)\nself.create_timer(PERIOD, self.tick)", False),
        ("every(1.0, self.tick)", False),
    ],
)
def test_it_is_known_whether_the_source_says_all_periods(text: str, known: bool) -> None:
    assert timer_periods([SourceFile(NODE, "file", data=text.encode())]).are_known is known


@pytest.mark.parametrize(
    ("fastest", "fine", "grid"),
    [
        (None, False, GRID),
        (1.0, False, GRID),
        (0.999, True, GRID),
        (0.05, True, GRID),
        (0.01, True, 100),
        (0.0001, True, FASTEST * OUTPUT.period),
    ],
)
def test_a_session_goes_in_steps_of_the_fastest_timer(
    fastest: float | None,
    fine: bool,
    grid: float,
    runs: Callable[..., Session],  # noqa: F811
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asked: list[tuple[bool, float]] = []

    def observed(*_: object, **named: object) -> Run:
        asked.append((bool(named["fine"]), float(str(named["grid"]))))
        return replace(right_run())

    opened = runs()
    monkeypatch.setattr(session, "observe", observed)
    opened._periods = TimerPeriods((fastest,))
    opened.run(unheard)
    assert [found for found, _ in asked] == [fine]
    assert asked[0][1] == pytest.approx(grid)
