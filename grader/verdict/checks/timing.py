"""The run stage, part 3: do the lines come at the right instants?"""

from __future__ import annotations

import statistics
from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

from grader.base.i18n.message import say
from grader.package.source.place import place_of
from grader.package.source.sleeps import longest_sleep
from grader.verdict.checks.declare import RUN, check
from grader.verdict.checks.faults import line_of, words
from grader.verdict.checks.spinning import timer_of_other_clock
from grader.verdict.node_files import source_of_node
from grader.verdict.outcome import Blocked, Failed, Inconclusive, Passed

if TYPE_CHECKING:
    from grader.run.observer import Event
    from grader.verdict.evidence import Evidence

WALL_TOLERANCE, WALL_SLACK = 0.05, 0.02  # a share of the period, and seconds


@check(
    "run.period",
    stage=RUN,
    depends=["run.starts"],
    after=["run.output", "run.logger"],
    quotes="before_ctrl_c",
)
def period(evidence: Evidence) -> Passed:
    """A line comes once in each period, at the right instants."""
    run, wanted = evidence.run, evidence.assignment.output
    watch = run.watch
    events = watch.counted
    if not events or run.confirmed is False or run.flooded:
        raise Blocked(by="run.output")
    every = f"{wanted.period:g}"
    expected = say("one line every {period} s, the first after {period} s", period=every)
    if watch.clock == "wall":
        return _wall_period(evidence, expected)
    if any(event.n is not None for event in watch.before_start):
        raise Failed(
            "run.by_hand",
            expected=expected,
            actual=say("a line came before any time had passed"),
            where=line_of(evidence, watch.before_start[0].record),
            words=words(evidence),
        )
    on_time = [event for event in events if event.due is not None]
    stopped = len(on_time) > 1 and abs((watch.period or wanted.period) - wanted.period) < 0.001
    if not watch.early and (not watch.missing or stopped):  # run.output reports a stop
        slow = _kept_apart(evidence, on_time)
        if slow:
            actual = say("a line about every {period} s", period=f"{slow:.2f}")
            raise _wrong_period(evidence, expected, actual, seconds=slow)
        each = say(
            "{count} lines, each at its instant (to 1 ms of ROS time), none in between",
            count=len(on_time),
        )
        return Passed(actual=each)
    late = events[0].virtual if watch.missing and events[0].due is None else 0.0
    single = watch.period is None and len(events) < 2
    if single and (late <= wanted.period or evidence.has_mistake("run.output", "run.stops")):
        raise Blocked(by="run.output")
    seen = watch.period or (late if len(events) < 2 else 0.0)
    actual = say("lines came at other instants")
    if seen:
        actual = say("a line about every {period} s", period=f"{seen:.2f}")
    raise _wrong_period(evidence, expected, actual, seconds=seen)


def _kept_apart(evidence: Evidence, on_time: Sequence[Event]) -> float:
    """Return the wall time (s) between the lines of a callback that takes more than a period.

    ROS time waits for the callback, so the lines are on time, but on a terminal they come late.
    That is what two runs measured without the machine's load, or else a sleep in the source: any
    other delay may be load. 0 if there is none.
    """
    held_up = evidence.run.held_up
    if held_up > evidence.assignment.output.period * (1 + WALL_TOLERANCE):
        return held_up
    source = source_of_node(evidence)
    slept = longest_sleep(source) if source is not None else None
    gaps = [after.wall - before.wall for before, after in pairwise(on_time)]
    if slept is None or slept[1] <= evidence.assignment.output.period or not gaps:
        return 0.0
    gap = statistics.median(gaps)
    return gap if gap >= slept[1] * (1 - WALL_TOLERANCE) else 0.0


def _wall_period(evidence: Evidence, expected: str) -> Passed:
    watch, wanted = evidence.run.watch, evidence.assignment.output
    if watch.period is None:
        raise Blocked(by="run.output")
    slack = wanted.period * WALL_TOLERANCE + WALL_SLACK
    median = f"{watch.period:.3f}"
    actual = say("a line every {period} s of wall time (median)", period=median)
    if abs(watch.period - wanted.period) <= slack:
        _must_use_ros_time(evidence)
        return Passed(actual=actual, advice=_advice(evidence))
    if evidence.run.inconsistent and evidence.has_failed("run.output"):
        raise Blocked(by="run.output")  # lines beside the count, whose gaps are chance
    if evidence.run.inconsistent:
        busy = say(
            "{actual}, but another run differed: the machine is too busy to tell", actual=actual
        )
        raise Inconclusive(busy)
    raise _wrong_period(evidence, expected, actual, seconds=watch.period)


def _must_use_ros_time(evidence: Evidence) -> None:
    """Raise Failed for a timer with a clock of its own, unless the assignment allows any."""
    if evidence.assignment.timer == "any" or not evidence.run.watch.while_still:
        return
    timer = timer_of_other_clock(evidence)
    source = source_of_node(evidence)
    if timer is None or source is None:
        return
    raise Failed(
        "run.other_clock",
        expected=say("a timer on the node's clock, which is ROS time"),
        actual=say("a timer, but not on the node's clock: it goes on while ROS time stands still"),
        where=place_of(source, timer.call),
        words=words(evidence),
    )


def _advice(evidence: Evidence) -> list[str]:
    """Return why the period was measured on the wall clock; run.spins says it if it failed."""
    note, still = evidence.run.watch.note, evidence.run.watch.while_still
    if evidence.has_failed("run.spins") or evidence.assignment.timer == "any":
        return []
    if still is False:
        return [
            say(
                "Measured on the wall clock, because {note}. Write rclpy.init(args=args): it "
                "gives the node the arguments of ros2 run, such as use_sim_time.",
                note=note,
            )
        ]
    return [
        say(
            "Measured on the wall clock, because {note}. A timer made with create_timer follows "
            "ROS time, in simulation too; a loop with sleep does not.",
            note=note,
        )
    ]


def _wrong_period(evidence: Evidence, expected: str, actual: str, *, seconds: float) -> Failed:
    watch = evidence.run.watch
    return Failed(
        "run.wrong_period",
        expected=expected,
        actual=actual,
        where=line_of(evidence, watch.counted[0].record),
        params={"period": round(seconds, 3)},
        words=words(evidence),
    )
