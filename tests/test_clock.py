"""Virtual time with a terminal that is slower than the network, as in a container."""

from __future__ import annotations

import time
from collections import Counter
from dataclasses import dataclass, field, replace

import pytest

from grader.course.load import load_assignment
from grader.run.clock import MOST_AT_ONCE, VirtualClock, watch_wall
from grader.run.observer import GRACE, LATE_GRACE, SECOND, Event, Observer, Watch
from grader.run.probe_link import Answer, LogRecord, ProbeLink
from grader.run.terminal import Terminal
from grader.sandbox.base import Console
from grader.sandbox.scheduling import RunClock
from tests.test_observer import COURSE

OUTPUT = load_assignment(COURSE).output


@dataclass
class SlowConsole(Console):
    """A terminal whose output arrives at the second read, or after a wait."""

    pieces: list[bytes] = field(default_factory=list)
    shown: bytes = b""
    looks: int = 0  # since the last output

    def wait(self, seconds: float) -> bool:
        self.looks += bool(self.pieces)
        if self.pieces and not self.shown and (seconds or self.looks > 1):
            self.shown = self.pieces.pop(0)
            self.looks = 0
        return bool(self.shown)

    def read(self) -> bytes:
        shown, self.shown = self.shown, b""
        return shown

    def interrupt(self) -> None:
        raise OSError

    def poll(self) -> tuple[int | None, int | None] | None:
        return None

    def end(self) -> None:
        self.pieces.clear()


class Node(ProbeLink):
    """A node that counts on /clock, as seen by its probe, with prints around each log line."""

    def __init__(
        self,
        console: SlowConsole,
        *,
        before: str = "",
        after: str = "",
        text: str = OUTPUT.text,
        period: float = OUTPUT.period,
        barrier: bool | None = True,
        multiplies: bool = False,
        grows: int = 0,
    ) -> None:
        self._console = console
        self._at_once = 1
        self._multiplies = multiplies  # whether each timer creates another one
        self._grows = grows  # how many more timers another one creates in each period
        self._prints = (before, after)
        self._text, self._period, self._barrier = text, period, barrier
        self._count = 0
        self._next = round(period * SECOND) * (1 + bool(grows))

    def ask(self, do: str, *, seconds: float = 0, **more: int | str) -> Answer:
        logs = []
        if do == "wait":
            time.sleep(min(seconds, 0.01))
        if do == "clock" and int(more["at"]) >= self._next:
            # (after a jump a timer runs once, then at the next multiple of its period)
            period = round(self._period * SECOND)
            self._next = int(more["at"]) // period * period + period
            for _ in range(self._at_once):
                logs.append(self._log())
            self._at_once = self._at_once * (1 + self._multiplies) + self._grows
        return Answer(barrier=self._barrier, logs=tuple(logs))

    def _log(self, stamp: int | None = None) -> LogRecord:
        text = self._text.format(n=self._count)
        stamp = stamp or time.time_ns()
        line = f"[INFO] [{stamp // SECOND}.{stamp % SECOND:09}] [node]: {text}\r\n"
        before, after = (words.format(n=self._count) for words in self._prints)
        pieces = (before, line, after)
        self._console.pieces += [piece.encode() for piece in pieces if piece]
        self._count += 1
        return LogRecord(20, "node", text, "", "", 1, stamp)


def driven(node: Node, console: SlowConsole) -> Watch:
    """Return what the clock finds of a node."""
    observer = Observer(Terminal(console, most=1_000_000), node, OUTPUT)
    watch = Watch()
    VirtualClock(observer, OUTPUT, deadline=time.monotonic() + 30).drive(watch, lambda event: None)
    return watch


@pytest.mark.parametrize(
    ("before", "after"),
    [("Hello time: {n}\r\n", ""), ("", "Hello time: {n}\r\n"), ("counting\r\n", "counted\r\n")],
    ids=["printed before", "printed after", "both"],
)
def test_late_terminal_output_belongs_to_its_own_tick(before: str, after: str) -> None:
    console = SlowConsole()
    node = Node(console, before=before, after=after)
    watch = driven(node, console)
    assert (watch.early, watch.missing, watch.period) == ([], [], None)
    assert {(e.n, e.due) for e in watch.counted} == {(k, k) for k in range(OUTPUT.ticks)}


@pytest.mark.parametrize("text", ["Hello time: {n}", "hello {n}"])
@pytest.mark.parametrize("library", ["rcl", "rcl.logging_rosout", "rmw_fastrtps_cpp", "rcutils"])
def test_lines_of_the_libraries_below_rclpy_are_not_the_nodes(library: str, text: str) -> None:
    console = SlowConsole()
    words = f"[ERROR] [5.000000000] [{library}]: Failed to parse type hash ''\r\n"
    watch = driven(Node(console, before=words, after=words, text=text), console)
    assert len(watch.events) == OUTPUT.ticks
    assert {event.logger for event in watch.events} == {""}
    assert [event.text for event in watch.counted] == [
        text.format(n=n) for n in range(OUTPUT.ticks)
    ]


def test_a_line_that_looks_like_a_record_of_the_node_is_judged() -> None:
    console = SlowConsole()
    observer = Observer(Terminal(console, most=1_000_000), Node(console), OUTPUT)
    console.pieces = [b"[INFO] [5.000000000] [rclpy_node]: Hello time: 0\r\n"]
    events = [*observer.take(), *observer.take(), *observer.settle()]
    assert [(event.source, event.logger) for event in events] == [("faked", "rclpy_node")]


def test_what_any_program_of_a_run_prints_is_an_event() -> None:
    first, second = SlowConsole(), SlowConsole()
    others = [Terminal(second, most=1_000_000)]
    observer = Observer(Terminal(first, most=1_000_000), Node(first), OUTPUT, others)
    first.pieces, second.pieces = [b"I talk\r\n"], [b"I hear\r\n"]
    events = [*observer.take(), *observer.take()]
    assert [(event.source, event.text) for event in events] == [
        ("print", "I talk"),
        ("print", "I hear"),
    ]


class SetClock(RunClock):
    """A clock of a run that goes on when it is told to."""

    at = 0.0

    def now(self, *, at_once: bool = False) -> float:
        return self.at


def test_a_record_that_waits_for_a_core_is_no_forgery() -> None:
    console, clock = SlowConsole(), SetClock()
    observer = Observer(Terminal(console, most=1_000_000, run_clock=clock), Node(console), OUTPUT)
    console.pieces = [b"[INFO] [5.000000000] [node]: Hello time: 0\r\n"]
    assert [*observer.take(), *observer.take()] == []
    time.sleep(2 * GRACE)  # on a busy machine, on which the probe has had no core
    assert observer.take() == []
    clock.at += 2 * LATE_GRACE
    assert [event.source for event in observer.take()] == ["faked"]


def test_how_far_a_count_gets_after_ctrl_c_does_not_count() -> None:
    console, clock = SlowConsole(), SetClock()
    observer = Observer(Terminal(console, most=1_000_000, run_clock=clock), Node(console), OUTPUT)
    console.pieces = [b"[INFO] [5.000000000] [node]: Hello time: 9\r\nbye\r\nHello time: 9\r\n"]
    observer.take()
    clock.at += 2 * LATE_GRACE
    assert [event.text for event in observer.take_last()] == ["bye"]


def test_a_logger_that_is_not_shown_is_waited_for_only_once() -> None:
    console = SlowConsole()
    node = Node(console, before="", after="")
    observer = Observer(Terminal(console, most=1_000_000), node, OUTPUT)
    records = node.ask("clock", at=SECOND).logs
    console.pieces = [b"no record of its own\r\n"]
    assert [event.text for event in observer.catch_up(records)] == ["no record of its own"]
    console.pieces = [b"and another\r\n"]
    assert observer.catch_up(records) == []


@pytest.mark.parametrize("text", ["Hello World", "hello {n}"])
@pytest.mark.parametrize("period", [0.1, 0.5, 2.0])
def test_the_period_of_another_text_is_measured_too(text: str, period: float) -> None:
    console = SlowConsole()
    watch = driven(Node(console, text=text, period=period), console)
    assert watch.period == pytest.approx(period)
    assert watch.early or watch.missing
    assert len(watch.counted) > 2


def test_another_text_at_the_right_instants_has_the_right_period() -> None:
    console = SlowConsole()
    watch = driven(Node(console, text="Hello World"), console)
    assert (watch.early, watch.missing) == ([], [])
    assert [event.due for event in watch.counted] == list(range(OUTPUT.ticks))


@pytest.mark.parametrize(("period", "right"), [(OUTPUT.period, True), (0.5, False)])
def test_a_node_without_services_is_judged_by_the_clock_alone(period: float, right: bool) -> None:
    console = SlowConsole()
    watch = driven(Node(console, period=period, barrier=None), console)
    assert watch.clock == "virtual"
    assert not watch.settled
    assert (not watch.early and not watch.missing and len(watch.dues) == OUTPUT.ticks) == right


def test_the_clock_is_not_driven_on_when_timers_multiply() -> None:
    console = SlowConsole()
    watch = driven(Node(console, multiplies=True), console)
    assert (watch.clock, watch.early, watch.missing) == ("virtual", [], [])
    assert len(watch.counted) == sum(2**k for k in range(MOST_AT_ONCE.bit_length() + 1))


def test_lines_of_more_and_more_timers_have_the_period_of_each() -> None:
    console = SlowConsole()
    watch = driven(Node(console, grows=2), console)
    assert (watch.clock, watch.period) == ("virtual", OUTPUT.period)
    at_once = Counter(event.due for event in watch.counted if event.due is not None)
    assert len(at_once) > 2
    assert sorted(at_once.values()) == [*at_once.values()]
    assert max(at_once.values()) > MOST_AT_ONCE


class Fast(Node):
    """A node that logs without a pause, or `most` lines at once, whatever the clock shows."""

    def __init__(self, console: SlowConsole, *, most: int, each: int) -> None:
        super().__init__(console, barrier=False)
        self._left, self._each = most, each

    def ask(self, do: str, *, seconds: float = 0, **more: int | str) -> Answer:
        answer = super().ask(do, seconds=seconds, **more)
        logs = [self._log() for _ in range(min(self._each, self._left))]
        self._left -= len(logs)
        joined = b"".join(self._console.pieces)
        self._console.pieces[:] = [joined] if joined else []
        return replace(answer, logs=(*answer.logs, *logs))


@pytest.mark.full
@pytest.mark.parametrize(("most", "flood"), [(100_000, True), (60, False)])
def test_lines_without_a_pause_are_a_flood_before_the_limit_of_the_output(
    most: int, flood: bool
) -> None:
    console = SlowConsole()
    node = Fast(console, most=most, each=20)
    observer = Observer(Terminal(console, most=100_000_000), node, OUTPUT)
    watch = Watch()
    clock = VirtualClock(observer, OUTPUT, deadline=time.monotonic() + 6)
    clock.drive(watch, lambda event: None)
    assert observer.flooded == flood


def test_lines_of_the_clock_are_not_several_at_one_time_on_the_wall() -> None:
    console = SlowConsole()
    node = Node(console)
    observer = Observer(Terminal(console, most=1_000_000), node, OUTPUT)
    event = Event("Hello time: 0", time.time(), 1.0, "logger", 0, due=0)
    watch = Watch(events=[event, replace(event, n=1, text="Hello time: 1")])
    watch_wall(observer, OUTPUT, watch, lambda event: None, deadline=time.monotonic() + 0.1)
    assert [(event.n, event.due) for event in watch.counted] == [(0, None), (1, None)]


@pytest.mark.parametrize(("moments", "silent"), [([0.1, 0.2, 0.3], 1.0), ([0.6, 0.7, 0.8], 0.7)])
def test_the_period_on_the_wall_is_that_of_the_lines_of_then(
    moments: list[float], silent: float
) -> None:
    console, clock = SlowConsole(), SetClock()
    node = OnTheWall(console, clock, list(moments))
    observer = Observer(Terminal(console, most=1_000_000, run_clock=clock), node, OUTPUT)
    now = time.time()
    fast = [Event(f"Hello time: {n}", now - 1 + n / 100, n, "logger", n, due=n) for n in range(9)]
    watch = Watch(events=fast)
    watch_wall(observer, OUTPUT, watch, lambda event: None, deadline=1.5)
    assert len(watch.counted) == 12
    assert watch.period == pytest.approx(0.1, abs=0.02)
    assert watch.silent == pytest.approx(silent, abs=0.02)


class OnTheWall(Node):
    """A node that logs at moments of a clock, in seconds; each look at it takes a hundredth."""

    def __init__(self, console: SlowConsole, clock: SetClock, moments: list[float]) -> None:
        super().__init__(console)
        self._moments, self._clock, self._began = moments, clock, time.time_ns()

    def ask(self, do: str, *, seconds: float = 0, **more: int | str) -> Answer:
        time.sleep(0.01)  # (no limit is over before its seconds on the wall)
        self._clock.at += 0.01
        logs = []
        if self._moments and self._clock.at > self._moments[0]:
            del self._moments[0]
            logs = [self._log(self._began + round(self._clock.at * SECOND) + SECOND)]
        return Answer(barrier=True, logs=tuple(logs))


def test_a_logged_text_that_the_terminal_cuts_has_its_record() -> None:
    console = SlowConsole()
    watch = driven(Node(console, text="x" * 5_000 + "{n}"), console)
    assert {event.source for event in watch.events} == {"logger"}


def test_a_logged_text_with_colour_codes_has_its_record() -> None:
    console = SlowConsole()
    watch = driven(Node(console, text="\x1b[92mHello time: {n}\x1b[0m"), console)
    assert {event.source for event in watch.events} == {"logger"}
    assert watch.counted[0].text == "\x1b[92mHello time: 0\x1b[0m"
