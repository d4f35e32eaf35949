"""The running stage, third part: do the lines come at the right instants?"""

from __future__ import annotations

from typing import TYPE_CHECKING

from grader.checks.faults import line_of
from grader.checks.registry import Blocked
from grader.checks.registry import Failed
from grader.checks.registry import Inconclusive
from grader.checks.registry import Passed
from grader.checks.registry import check

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
    expected = f"one line every {wanted.period:g} s, the first after {wanted.period:g} s"
    if watch.clock == "wall":
        return _wall_period(evidence, expected)
    if any(event.n is not None for event in watch.before_start):
        raise Failed(
            expected=expected,
            actual="a line came before any time had passed",
            where=line_of(evidence, watch.before_start[0].record),
            rationale="The timer calls the callback when its time has come. A call by hand "
            "(self.timer_callback() in __init__) is one too many.",
            fix="Take the call out; give create_timer the callback's name and let it call.",
            mistake="run.by_hand",
        )
    on_time = [event for event in events if event.due is not None]
    stopped = len(on_time) > 1 and abs((watch.period or wanted.period) - wanted.period) < 0.001
    if not watch.early and (not watch.missing or stopped):  # that it stops is run.output's to say
        return Passed(
            actual=f"{len(on_time)} lines, each at its instant (to 1 ms of ROS time), none between"
        )
    if watch.period is None:
        if len(events) < 2:
            raise Blocked(by="run.output")
        actual = "lines came at other instants"
    else:
        actual = f"a line about every {watch.period:.2f} s"
    raise Failed(
        expected=expected,
        actual=actual,
        where=line_of(evidence, events[0].record),
        rationale="The first argument of create_timer is the period in seconds.",
        fix=f"Write create_timer({wanted.period!r}, self.timer_callback), once.",
        mistake="run.wrong_period",
        params={"period": round(watch.period or 0.0, 3)},
    )


def _wall_period(evidence: Evidence, expected: str) -> Passed:
    watch, wanted = evidence.run.watch, evidence.assignment.output
    if watch.period is None:
        raise Blocked(by="run.output")
    slack = wanted.period * WALL_TOLERANCE + WALL_SLACK
    actual = f"a line every {watch.period:.3f} s of wall time (median)"
    if abs(watch.period - wanted.period) <= slack:
        advice = (
            f"Judged on the wall clock, since {watch.note}. A timer made with create_timer follows "
            "ROS time, in simulation too; a loop with sleep does not."
        )
        return Passed(actual=actual, advice=[advice])
    if evidence.run.inconsistent:
        raise Inconclusive(f"{actual}, but another run differed: the machine is too busy to tell")
    raise Failed(
        expected=expected,
        actual=actual,
        where=line_of(evidence, watch.counted[0].record),
        rationale="The first argument of create_timer is the period in seconds.",
        fix=f"Write create_timer({wanted.period!r}, self.timer_callback), once.",
        mistake="run.wrong_period",
        params={"period": round(watch.period, 3)},
    )
