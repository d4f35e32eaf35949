"""The running stage, third part: do the lines come at the right instants?"""

from __future__ import annotations

from typing import TYPE_CHECKING

from grader.checks.faults import line_of
from grader.checks.registry import Blocked
from grader.checks.registry import Failed
from grader.checks.registry import Inconclusive
from grader.checks.registry import Passed
from grader.checks.registry import check
from grader.locale.message import say

if TYPE_CHECKING:
    from grader.evidence import Evidence

WALL_TOLERANCE, WALL_SLACK = 0.05, 0.02  # of the period, and seconds


@check("run.period", depends=["run.starts"])
def period(evidence: Evidence) -> Passed:
    """A line comes once in each period, at the right instants."""
    run, wanted = evidence.run, evidence.assignment.output
    watch = run.watch
    events = watch.counted
    if not events:
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
        )
    on_time = [event for event in events if event.due is not None]
    stopped = len(on_time) > 1 and abs((watch.period or wanted.period) - wanted.period) < 0.001
    if not watch.early and (not watch.missing or stopped):  # that it stops is run.output's to say
        each = say(
            "{count} lines, each at its instant (to 1 ms of ROS time), none between",
            count=len(on_time),
        )
        return Passed(actual=each)
    if watch.period is None:
        if len(events) < 2:
            raise Blocked(by="run.output")
        actual = say("lines came at other instants")
    else:
        actual = say("a line about every {period} s", period=f"{watch.period:.2f}")
    raise _wrong_period(evidence, expected, actual)


def _wall_period(evidence: Evidence, expected: str) -> Passed:
    watch, wanted = evidence.run.watch, evidence.assignment.output
    if watch.period is None:
        raise Blocked(by="run.output")
    slack = wanted.period * WALL_TOLERANCE + WALL_SLACK
    median = f"{watch.period:.3f}"
    actual = say("a line every {period} s of wall time (median)", period=median)
    if abs(watch.period - wanted.period) <= slack:
        advice = say(
            "Judged on the wall clock, since {note}. A timer made with create_timer follows "
            "ROS time, in simulation too; a loop with sleep does not.",
            note=watch.note,
        )
        return Passed(actual=actual, advice=[advice])
    if evidence.run.inconsistent:
        busy = say(
            "{actual}, but another run differed: the machine is too busy to tell", actual=actual
        )
        raise Inconclusive(busy)
    raise _wrong_period(evidence, expected, actual)


def _wrong_period(evidence: Evidence, expected: str, actual: str) -> Failed:
    watch, wanted = evidence.run.watch, evidence.assignment.output
    period = round(watch.period or 0.0, 3)
    return Failed(
        "run.wrong_period",
        expected=expected,
        actual=actual,
        where=line_of(evidence, watch.counted[0].record),
        params={"period": period},
        words={"wanted": repr(wanted.period)},
    )
