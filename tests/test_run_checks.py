"""The run checks on constructed runs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Literal

import pytest

from grader.run.observer import Event, Watch
from grader.run.probe_link import LogRecord, NodeSeen
from grader.run.run import Run
from grader.verdict.checks.counting import counts
from grader.verdict.checks.declare import Check
from grader.verdict.checks.faults import calls_to, raised_in, raised_inside
from grader.verdict.checks.logger import logger
from grader.verdict.checks.spinning import spins
from grader.verdict.checks.starting import interrupt
from grader.verdict.checks.timing import period
from grader.verdict.evidence import Evidence
from grader.verdict.outcome import Blocked, Failed, Inconclusive, Passed
from tests.corpus.build import SOLUTION
from tests.report.samples import check as check_result
from tests.static_bench import BUILT, NODE, Bench, asked

RIGHT = (SOLUTION / NODE).read_text(encoding="utf-8")
STEP = "self.counter_ += 1"
HANDLER = """\
Traceback (most recent call last):
  File "/ws/build/my_robot_controller/my_robot_controller/my_first_node.py", line 25, in main
    rclpy.spin(node)
KeyboardInterrupt

During handling of the above exception, another exception occurred:

Traceback (most recent call last):
  File "/ws/build/my_robot_controller/my_robot_controller/my_first_node.py", line {line}, in main
{error}
"""
PLAIN = HANDLER[: HANDLER.index("\nDuring")]


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    return Bench(tmp_path / "my_robot_controller")


def ask(check: Check, bench: Bench, run: Run, source: str = RIGHT) -> Passed:
    bench.write(NODE, source)
    static = bench.evidence()
    return asked(
        check, Evidence(static.assignment, static.submission, build=lambda: BUILT, run=lambda: run)
    )


ITEM = "TypeError: 'tuple' object does not support item assignment"


def line(n: int, *, virtual: float, wall: float, due: int | None) -> Event:
    return Event(f"Hello time: {n}", wall, virtual, "logger", n, due)


def on_time(walls: Sequence[float]) -> Run:
    """Return a run in which each line came at its instant of ROS time."""
    events = [line(n, virtual=n + 1, wall=wall, due=n) for n, wall in enumerate(walls)]
    dues = [event.virtual for event in events]
    return Run("ros2 run", Watch(clock="virtual", events=events, dues=dues), started=True)


def ended(transcript: str, status: int) -> Run:
    """Return a run that ended by Ctrl+C."""
    return Run(
        "ros2 run",
        started=True,
        interrupted=True,
        stop_seconds=0.3,
        status=status,
        transcript=transcript,
    )


def test_a_single_very_late_line_is_a_wrong_period(bench: Bench) -> None:
    seen = Watch(clock="virtual", dues=[1.0], missing=[0])
    seen.events.append(line(0, virtual=10.0, wall=1.0, due=None))
    with pytest.raises(Failed) as caught:
        ask(period, bench, Run("ros2 run", seen, started=True))
    assert caught.value.mistake.id == "run.wrong_period"
    assert caught.value.mistake.params == {"period": 10.0}
    assert "10.00 s" in caught.value.actual


def test_a_single_line_on_time_is_left_to_the_output_check(bench: Bench) -> None:
    run = on_time([0.1])
    run.watch.dues.append(2.0)
    run.watch.missing.append(1)
    run.watch.early.append(line(1, virtual=1.5, wall=0.2, due=None))
    with pytest.raises(Blocked) as caught:
        ask(period, bench, run)
    assert caught.value.by == "run.output"


def test_a_callback_that_sleeps_longer_than_the_period_is_late(bench: Bench) -> None:
    source = RIGHT.replace(STEP, f"{STEP}\n        time.sleep(3)")
    with pytest.raises(Failed) as caught:
        ask(period, bench, on_time([0.1, 3.1, 6.2, 9.2]), source)
    assert caught.value.mistake.params["period"] == pytest.approx(3.0, abs=0.11)


@pytest.mark.parametrize(
    ("source", "walls"),
    [
        (RIGHT, [0.1, 3.1, 6.2, 9.2]),
        (RIGHT.replace(STEP, f"{STEP}\n        time.sleep(0.9)"), [0.1, 3.1, 6.2, 9.2]),
        (RIGHT.replace(STEP, f"{STEP}\n        later(lambda: time.sleep(3))"), [0.1, 0.2, 0.3]),
    ],
)
def test_a_slow_machine_makes_no_node_late(bench: Bench, source: str, walls: list[float]) -> None:
    assert ask(period, bench, on_time(walls), source) is not None


@pytest.mark.parametrize(
    "error",
    ["NameError: name 'KeyboardInterupt' is not defined. Did you mean: 'KeyboardInterrupt'?",
     "AttributeError: 'MyFirstNode' object has no attribute 'destroy'"],
)  # fmt: skip
def test_a_failing_ctrl_c_handler_is_an_error_at_the_stop(bench: Bench, error: str) -> None:
    with pytest.raises(Failed) as caught:
        ask(interrupt, bench, ended(HANDLER.format(line=26, error=error), status=1))
    assert caught.value.mistake.id == "run.error_at_stop"
    assert caught.value.where is not None
    assert caught.value.where.line == 26


@pytest.mark.parametrize(
    "transcript",
    [
        PLAIN,
        HANDLER.format(line=29, error="rclpy._rclpy_pybind11.RCLError: context is not valid"),
        HANDLER.format(line=29, error="rclpy.executors.ExternalShutdownException"),
        PLAIN + "Exception ignored in: <function x>\nAttributeError: 'NoneType' object\n",
    ],
)
def test_the_traceback_of_ctrl_c_itself_is_not_an_error(bench: Bench, transcript: str) -> None:
    assert ask(interrupt, bench, ended(transcript, status=1)) is not None


OWN = (
    '  File "/ws/build/my_robot_controller/my_robot_controller/my_first_node.py", line {}, in {}\n'
)
SPUN = '  File "/opt/ros/lib/python3/site-packages/rclpy/__init__.py", line 226, in spin\n'
HEAD = "Traceback (most recent call last):\n"


@pytest.mark.parametrize(
    ("frames", "library", "line", "calls"),
    [
        (OWN.format(25, "main") + SPUN, "rclpy", 25, [("main", 25)]),
        (
            OWN.format(25, "main") + SPUN + OWN.format(16, "say"),
            "",
            16,
            [("main", 25), ("say", 16)],
        ),
        ('  File "/usr/lib/python3.12/threading.py", line 1012, in run\n', "Python", None, []),
    ],
)
def test_the_code_that_raised_an_error_is_known(
    bench: Bench, frames: str, library: str, line: int | None, calls: list[tuple[str, int]]
) -> None:
    earlier = f"{HEAD}{OWN.format(99, 'other')}ValueError: caught\n"
    run = Run("ros2 run", transcript=f"{earlier}{HEAD}{frames}TypeError: x\n", status=1)
    evidence = bench.evidence()
    error, where = raised_in(evidence, run)
    assert error == "TypeError: x"
    assert (where.line if where else None) == line
    assert raised_inside(evidence, run) == library
    assert calls_to(evidence, run) == calls


def counted(**more: object) -> Run:
    """Return a right run of twelve lines with other facts about it."""
    run = on_time([0.1 * n for n in range(12)])
    run.nodes = (
        NodeSeen("/my_first_node", clock=True, rosout=True, parameters=True, answers=True),
    )
    run.watch.settled = True
    return replace(run, **more)  # type: ignore[arg-type]


@pytest.mark.parametrize("check", [counts, logger, period, spins])
def test_a_node_that_does_not_count_in_a_plain_run_gets_no_point_for_its_lines(
    bench: Bench, check: Check
) -> None:
    for confirmed in (True, None):
        ask(check, bench, counted(confirmed=confirmed))
    with pytest.raises((Failed, Blocked)) as caught:
        ask(check, bench, counted(confirmed=False))
    if isinstance(caught.value, Blocked):
        assert caught.value.by == "run.output"
    else:
        assert isinstance(caught.value, Failed)
        assert caught.value.mistake.id == "run.only_when_marked"


def test_the_line_that_asks_where_it_runs_is_named(bench: Bench) -> None:
    source = RIGHT.replace("        self.counter_ = 0", "        self.counter_ = len(sys.argv) - 4")
    with pytest.raises(Failed) as caught:
        ask(counts, bench, counted(confirmed=False), source)
    where = caught.value.where
    assert where is not None
    assert where.line is not None
    assert "sys.argv" in source.splitlines()[where.line - 1]


def test_records_of_a_node_with_two_publishers_on_rosout_prove_nothing(bench: Bench) -> None:
    with pytest.raises(Failed) as caught:
        ask(logger, bench, counted(doubled="/my_first_node"))
    assert caught.value.mistake.id == "run.faked_log"
    assert "/my_first_node has a second publisher on /rosout" in caught.value.actual


@pytest.mark.parametrize("ahead", [60.0, -31.0, -7200.0])
def test_records_with_a_time_that_no_logger_gives_prove_nothing(bench: Bench, ahead: float) -> None:
    """It is of the future, or of before the run. One can be due to a clock that was set."""
    one, two = stamped(counted(), ahead, most=1), stamped(counted(), ahead, most=2)
    assert ask(logger, bench, one)
    with pytest.raises(Failed) as caught:
        ask(logger, bench, two)
    assert caught.value.mistake.id == "run.faked_log"
    assert "2 records" in caught.value.actual


def test_records_that_are_read_late_are_still_the_loggers(bench: Bench) -> None:
    assert ask(logger, bench, stamped(counted(), -20.0, most=10))


def test_a_clock_that_is_set_back_forges_no_record(bench: Bench) -> None:
    back = stamped(counted(), -0.1, most=10)
    back.began += 60_000_000_000
    assert ask(logger, bench, back)


def stamped(run: Run, ahead: float, *, most: int) -> Run:
    """Return a run whose first records were read so many seconds before their stamp.

    All are read 30 s after the run began.
    """
    run.began = 1_799_999_970_000_000_000
    for n, event in enumerate(run.watch.events[:most]):
        read = 1_800_000_000_000_000_000
        stamp = read + round(ahead * 1e9)
        record = LogRecord(20, "my_first_node", event.text, "", "", 10, stamp, read)
        run.watch.events[n] = replace(event, record=record)
    return run


def test_lines_that_were_erased_are_not_taken_for_a_silent_node(bench: Bench) -> None:
    silent = Run("ros2 run", Watch(clock="virtual"), started=True, erased=5)
    with pytest.raises(Failed) as caught:
        ask(counts, bench, silent)
    assert caught.value.mistake.id == "run.erased"


def test_callbacks_that_hold_up_the_clock_are_a_longer_period(bench: Bench) -> None:
    assert ask(period, bench, counted(held_up=0.9)) is not None
    with pytest.raises(Failed) as caught:
        ask(period, bench, counted(held_up=1.8))
    assert caught.value.mistake.id == "run.wrong_period"
    assert "1.80 s" in caught.value.actual


def with_others(text: str, *, from_line: int) -> Run:
    """Return a run in which another line comes at each due instant from one on."""
    run = counted()
    run.watch.events[from_line:] = [
        replace(event, text=text.format(n=event.n), n=None)
        for event in run.watch.events[from_line:]
    ]
    return run


@pytest.mark.parametrize("clock", ["virtual", "wall"])
@pytest.mark.parametrize(
    ("text", "mistake"),
    [("and so on", "run.stops"), ("Hello time: {n:x}h", "run.wrong_text")],
    ids=["another line", "the line in another form"],
)
def test_a_count_must_go_on_and_other_lines_do_not_stand_for_it(
    bench: Bench, text: str, mistake: str, clock: Literal["virtual", "wall"]
) -> None:
    run = with_others(text, from_line=4)
    run.watch.clock = clock
    if clock == "wall":
        run.watch.events[:] = [replace(event, wall=event.virtual) for event in run.watch.events]
    with pytest.raises(Failed) as caught:
        ask(counts, bench, run)
    assert caught.value.mistake.id == mistake


def test_the_call_that_logs_the_count_logs_another_text(bench: Bench) -> None:
    run = with_others("Hello time: 0Hello time: {n} and all the others before it", from_line=1)
    at = LogRecord(20, "my_first_node", "", "timer_callback", f"/src/{NODE}", 11, 0)
    run.watch.events[:] = [replace(event, record=at) for event in run.watch.events]
    with pytest.raises(Failed) as caught:
        ask(counts, bench, run)
    assert (caught.value.mistake.id, caught.value.variant) == ("run.wrong_text", "later")
    assert caught.value.words["count"] == 1
    assert caught.value.words["line"] == "Hello time: 1"


@pytest.mark.parametrize(
    ("text", "first", "advised"),
    [
        ("Bonjour: {}", 1, True),
        ("Bonjour: {}", 0, False),
        ("Bonjour {} of 10", 1, False),
        ("Bonjour: {}.5", 1, False),
        (f"Bonjour: {'9' * 5_000}{{}}", 1, False),
    ],
)
def test_a_wrong_start_is_told_beside_another_text(
    bench: Bench, text: str, first: int, advised: bool
) -> None:
    run = counted()
    run.watch.events[:] = [
        replace(event, text=text.format(first + k), n=None)
        for k, event in enumerate(run.watch.events)
    ]
    with pytest.raises(Failed) as caught:
        ask(counts, bench, run)
    assert caught.value.mistake.id == "run.wrong_text"
    assert [f"has to be 0, and it is {first}" in str(a) for a in caught.value.advice] == (
        [True] if advised else []
    )


def test_other_lines_beside_the_count_cost_nothing(bench: Bench) -> None:
    run = counted()
    beside = [replace(event, text="working", n=None) for event in run.watch.events]
    run.watch.events += beside
    passed = ask(counts, bench, run)
    assert passed is not None
    assert passed.advice


def test_a_period_of_lines_that_are_no_count_is_not_blamed_on_the_machine(bench: Bench) -> None:
    run = counted(inconsistent=True)
    run.watch.clock, run.watch.period = "wall", 0.3
    bench.write(NODE, RIGHT)
    static = bench.evidence()
    evidence = Evidence(static.assignment, static.submission, build=lambda: BUILT, run=lambda: run)
    with pytest.raises(Inconclusive):
        asked(period, evidence)
    evidence.results["run.output"] = check_result("run.output", "failed")
    with pytest.raises(Blocked):
        asked(period, evidence)


def every(seconds: float, *, step: int = 1) -> Run:
    """Return a run in which a line comes every so many seconds of ROS time."""
    events = [
        line(n * step, virtual=seconds * (n + 1), wall=n + 1.0, due=None if n % 10 else n)
        for n in range(6)
    ]
    seen = Watch(clock="virtual", events=events, dues=[1.0, 2.0], early=events[1:], period=seconds)
    return Run("ros2 run", seen, started=True)


def test_a_sleep_that_holds_the_lines_back_is_named_beside_the_timer(bench: Bench) -> None:
    source = RIGHT.replace("(1.0,", "(0.1,").replace(STEP, f"{STEP}\n        time.sleep(1)")
    with pytest.raises(Failed) as caught:
        ask(period, bench, every(0.1), source)
    assert (
        caught.value.actual == "a timer of 0.10 s, and a callback whose sleep holds the lines back"
    )
    with pytest.raises(Failed) as caught:
        ask(period, bench, every(0.1), source.replace("sleep(1)", "sleep(0.01)"))
    assert caught.value.actual == "a line about every 0.10 s"


def test_the_gaps_of_a_throttled_log_are_not_shown_as_a_period(bench: Bench) -> None:
    source = RIGHT.replace("str(self.counter_))", "str(self.counter_), throttle_duration_sec=1.0)")
    with pytest.raises(Failed) as caught:
        ask(period, bench, every(8.5, step=86), source)
    assert caught.value.actual == "lines came at other instants"


@pytest.mark.parametrize(("silent", "stops"), [(1.5, False), (6.0, True)])
def test_a_count_on_the_wall_clock_that_ends_is_no_count(
    silent: float, stops: bool, bench: Bench
) -> None:
    events = [line(n, virtual=0, wall=n, due=None) for n in range(4)]
    run = Run("ros2 run", Watch(clock="wall", events=events, silent=silent), started=True)
    if not stops:
        assert ask(counts, bench, run)
        return
    with pytest.raises(Failed) as caught:
        ask(counts, bench, run)
    assert caught.value.mistake.id == "run.stops"
    assert caught.value.actual == "4 lines, then no more came"


def test_the_lines_that_came_at_one_time_are_shown(bench: Bench) -> None:
    events = [
        line(n, virtual=due + 1, wall=due + 1, due=due) for n, due in enumerate((0, 1, 1, 2, 2))
    ]
    seen = Watch(clock="virtual", events=events, dues=[1.0, 2.0, 3.0])
    with pytest.raises(Failed) as caught:
        ask(counts, bench, Run("ros2 run", seen, started=True))
    assert caught.value.mistake.id == "run.twice"
    assert caught.value.actual.endswith(": Hello time: 1, Hello time: 2")


def test_a_line_before_the_error_is_not_denied(bench: Bench) -> None:
    first = Event("Hello time: (0,)", 1.0, 1.0, "logger", None, 0)
    seen = Watch(clock="virtual", events=[first], dues=[1.0])
    run = Run("ros2 run", seen, started=True, ended_by_itself=True, status=1)
    with pytest.raises(Failed) as caught:
        ask(counts, bench, run)
    assert caught.value.mistake.id == "run.ended_early"
    assert caught.value.actual.startswith("1 line, then the node ended by itself")
    seen.events.clear()
    with pytest.raises(Failed) as caught:
        ask(counts, bench, run)
    assert caught.value.actual.startswith("no line came: the node stopped")


@pytest.mark.parametrize(("raised", "variant"), [(True, "callback"), (False, "")])
def test_an_error_after_a_line_is_no_exit_to_look_for(
    raised: bool, variant: str, bench: Bench
) -> None:
    run = on_time([1.0])
    run.ended_by_itself, run.status = True, 1 if raised else 0
    run.transcript = f"Traceback (most recent call last):\n{ITEM}\n" if raised else ""
    with pytest.raises(Failed) as caught:
        ask(counts, bench, run)
    assert (caught.value.mistake.id, caught.value.variant) == ("run.ended_early", variant)


def test_a_number_that_does_not_change_is_followed_to_the_lines_that_make_it(bench: Bench) -> None:
    run = on_time([1.0, 2.0, 3.0])
    run.watch.events[:] = [replace(event, n=0) for event in run.watch.events]
    for source, variant in (
        (RIGHT, "lines"),
        (RIGHT.replace("self.counter_", "next(NUMBERS)"), ""),
    ):
        with pytest.raises(Failed) as caught:
            ask(counts, bench, run, source.replace("next(NUMBERS) = 0", "pass"))
        assert (caught.value.mistake.id, caught.value.variant) == ("run.constant_counter", variant)
