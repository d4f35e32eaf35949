"""The kind of check for the period of lines: do they come at the right instants?"""

from __future__ import annotations

import ast
import statistics
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING

from pydantic import Field

from grader.base.i18n.message import Value, say
from grader.mistakes.fixes.node_timer import value_of
from grader.package.source.node import NodeSource
from grader.package.source.period import is_right, number_in, seconds_of, timers_of_lines
from grader.package.source.place import place_of
from grader.package.source.real_time import THROTTLE
from grader.package.source.sleeps import longest_sleep
from grader.package.source.timer import Timer
from grader.report.model import Where
from grader.run.clock import GRID
from grader.run.run import WALL_TOLERANCE
from grader.verdict.checks.declare import kind
from grader.verdict.checks.faults import line_of, words
from grader.verdict.checks.instants import stops_before, wrong_gaps
from grader.verdict.checks.lines import CALLS, numbered, records, such_lines
from grader.verdict.checks.parameters import Parameters
from grader.verdict.checks.spinning import timer_of_other_clock
from grader.verdict.node_files import source_of_node
from grader.verdict.outcome import Blocked, Failed, Inconclusive, Passed

if TYPE_CHECKING:
    from grader.run.observer import Event
    from grader.verdict.evidence import Evidence
    from grader.verdict.use import Use

SHORT = 0.1  # seconds, below which a text shows milliseconds
WALL_SLACK = 0.02  # seconds, beside the share of a period on the wall clock
MOST_INSTANTS = 5  # of those whose lines are counted in a text
LONGEST_CODE = 80  # characters of a calculation in a text


class LinePeriod(Parameters):
    """The lines of a text, in which {n} stands for any number: one every `period` s of ROS time."""

    text: str
    period: float = Field(gt=0, allow_inf_nan=False)


@kind("log.period", LinePeriod, depends=["run.starts"], after=["log.counts", "log.logger"])
def period(use: Use[LinePeriod]) -> Passed:
    """A line comes in each period, at the right instants."""
    return _in_scenario(use) if use.in_scenario else _line_by_line(use.evidence, use.given.period)


def _in_scenario(use: Use[LinePeriod]) -> Passed:
    wanted, clock = use.given.period, use.plan.clock.period
    _, last = use.require_window()
    every = f"{wanted:g}"
    expected = say("one line every {period} s", period=every)
    found = records(use, numbered(use.given.text))
    if len(found) < 2:
        use.blocked_by("log.counts", text=use.given.text)
        where = use.call(*CALLS)
        actual = such_lines(len(found))
        raise Failed("log.missing", expected=expected, actual=actual, where=where)
    instants = [event.virtual for event in found]
    wrong = wrong_gaps(instants, wanted, clock)
    if not wrong and not stops_before(last, instants, wanted, clock):
        return Passed(actual=such_lines(len(found)))
    actual = say("the last line came at {at} s", at=f"{instants[-1]:g}")
    if wrong:
        actual = say("{gap} s between two lines", gap=f"{wrong[0]:g}")
    raise Failed(
        "log.wrong_period",
        expected=expected,
        actual=actual,
        where=use.call("create_timer"),
        words={"wanted": every},
    )


def _has_failed(evidence: Evidence, check_id: str) -> bool:
    result = evidence.results.get(check_id)
    return result is not None and result.status == "failed"


def _line_by_line(evidence: Evidence, wanted: float) -> Passed:
    run = evidence.run
    watch = run.watch
    events = watch.counted
    count = evidence.id_of("log.counts")
    if not events or run.confirmed is False or run.flooded:
        raise Blocked(by=count)
    every = f"{wanted:g}"
    expected = say("one line every {period} s, the first after {period} s", period=every)
    if watch.clock == "wall":
        return _wall_period(evidence, wanted, expected)
    if any(event.n is not None for event in watch.before_start):
        raise Failed(
            "run.by_hand",
            expected=expected,
            actual=say("a line came before any time had passed"),
            where=line_of(evidence, watch.before_start[0].record),
            words=words(evidence),
            follows=count if len(events) == 1 and _has_failed(evidence, count) else "",
        )
    on_time = [event for event in events if event.due is not None]
    at_one = len(on_time) > 1 and len({event.due for event in on_time}) == 1
    if at_one and watch.missing and watch.period is None and evidence.has_failed(count):
        raise Blocked(by=count)  # several lines at one instant, and none after it
    stopped = len(on_time) > 1 and abs((watch.period or wanted) - wanted) < 0.001
    if not watch.early and (not watch.missing or stopped):  # log.counts reports a stop
        slow = _kept_apart(evidence, on_time, wanted)
        if slow:
            actual = say("a line about every {period} s", period=_shown(slow))
            raise _wrong_period(evidence, expected, actual, seconds=slow)
        if more := _more_and_more(evidence, on_time):
            raise _wrong_period(evidence, expected, more, seconds=wanted)
        each = say(
            "{count} lines, each at its instant (to 1 ms of ROS time), none in between",
            count=len(on_time),
        )
        return Passed(actual=each)
    late = events[0].virtual if watch.missing and events[0].due is None else 0.0
    single = watch.period is None and len(events) < 2
    if single and (late <= wanted or evidence.has_mistake(count, "run.stops")):
        raise Blocked(by=count)
    seen = watch.period or (late if len(events) < 2 else 0.0)
    if evidence.has_failed(count) and abs(seen - wanted) <= wanted / GRID:
        raise Blocked(by=count)  # the timer is right, and its lines are too many
    raise _wrong_period(evidence, expected, _seen_every(evidence, seen), seconds=seen)


def _more_and_more(evidence: Evidence, on_time: Sequence[Event]) -> str:
    """Return how many lines came at each instant, if a timer is made again and again; "" if none is."""
    at_a_time = list(Counter(event.due for event in on_time).values())
    source = source_of_node(evidence)
    if source is None or at_a_time[-1:] <= at_a_time[:1]:
        return ""
    if not any(_is_made_again(source, timer) for timer in source.timers):
        return ""
    shown = ", ".join(map(str, at_a_time[:MOST_INSTANTS]))
    return say("more and more lines at a time: {counts}, …", counts=shown)


def _seen_every(evidence: Evidence, seconds: float) -> str:
    """Return at which instants of ROS time the lines came, as far as a terminal shows the same.

    What a throttled logger leaves out is not the timer's, and ROS time waits for a callback that
    sleeps.
    """
    source = source_of_node(evidence)
    if not seconds or (source is not None and _is_throttled(source)):
        return say("lines came at other instants")
    if source is not None and longest_sleep(source) >= seconds:
        return say(
            "a timer of {period} s, and a callback whose sleep holds the lines back",
            period=_shown(seconds),
        )
    return say("a line about every {period} s", period=_shown(seconds))


def _is_throttled(source: NodeSource) -> bool:
    """Whether a line of the node's log is written at most so often."""
    return any(option.arg == THROTTLE for call in source.own_logs for option in call.keywords)


def _shown(seconds: float) -> str:
    """Return a period as a text shows it."""
    return f"{seconds:.2f}" if seconds >= SHORT else f"{seconds:.3f}"


def _kept_apart(evidence: Evidence, on_time: Sequence[Event], wanted: float) -> float:
    """Return the wall time (s) between the lines of a callback that takes more than a period.

    ROS time waits for the callback, so the lines are on time, but on a terminal they come late.
    That is what two runs measured without the machine's load, or else a sleep in the source: any
    other delay may be load. 0 if there is none.
    """
    held_up = evidence.run.held_up
    if held_up > wanted * (1 + WALL_TOLERANCE):
        return held_up
    source = source_of_node(evidence)
    slept = longest_sleep(source) if source is not None else 0.0
    gaps = [after.wall - before.wall for before, after in pairwise(on_time)]
    if slept <= wanted or not gaps:
        return 0.0
    gap = statistics.median(gaps)
    return gap if gap >= slept * (1 - WALL_TOLERANCE) else 0.0


def _wall_period(evidence: Evidence, wanted: float, expected: str) -> Passed:
    watch, count = evidence.run.watch, evidence.id_of("log.counts")
    if watch.period is None:
        raise Blocked(by=count)
    slack = wanted * WALL_TOLERANCE + WALL_SLACK
    median = f"{watch.period:.3f}"
    actual = say("a line every {period} s of wall time (median)", period=median)
    if abs(watch.period - wanted) <= slack:
        _must_use_ros_time(evidence)
        return Passed(actual=actual, advice=_advice(evidence))
    if evidence.run.inconsistent and evidence.has_failed(count):
        raise Blocked(by=count)  # lines beside the count, whose gaps are chance
    if evidence.run.inconsistent:
        busy = say("{actual}, but the machine is too busy to tell", actual=actual)
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
    if evidence.run.plain:
        return []  # (run.starts says why it did not get the arguments)
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
    told, follows = _period_told(evidence), ""
    if told.variant == "there" and _leaves_numbers_out(evidence):
        follows = evidence.id_of("log.counts")
        actual = say("some lines do not come: the count goes on without them")
    return Failed(
        "run.wrong_period",
        expected=expected,
        actual=actual,
        where=told.where,
        variant=told.variant,
        params={"period": round(seconds, 3)},
        words={**words(evidence), **told.words},
        follows=follows,
    )


def _leaves_numbers_out(evidence: Evidence) -> bool:
    """Whether the count failed because lines are missing, and each missing line is a period.

    Then the node counts in each period, and only some lines do not come.
    """
    count, output = evidence.results.get(evidence.id_of("log.counts")), evidence.assignment.output
    events = [event for event in evidence.run.watch.counted if event.n is not None]
    if count is None or count.status != "failed" or count.visibility != "visible":
        return False
    on_wall = evidence.run.watch.clock == "wall"
    slack = WALL_SLACK + WALL_TOLERANCE * output.period if on_wall else 0.002
    most = 0.0
    for before, after in pairwise(events):
        periods = ((after.n or 0) - (before.n or 0)) / output.step
        gap = after.wall - before.wall if on_wall else after.virtual - before.virtual
        most = max(most, periods)
        if periods < 1 or abs(gap - periods * output.period) > slack * periods:
            return False
    return most > 1


@dataclass(frozen=True)
class Told:
    """Where the period of the first timer is written, and which text says so with which words."""

    where: Where
    variant: str = ""
    words: Mapping[str, Value] = field(default_factory=dict)


def _period_told(evidence: Evidence) -> Told:
    source = source_of_node(evidence)
    if source is None or not source.timers:
        return Told(line_of(evidence, evidence.run.watch.counted[0].record))
    return told_of_period(source, evidence.assignment.output.period)


def told_of_period(source: NodeSource, wanted: float) -> Told:
    """Return what to say of the period of the timer whose callback logs.

    A number that is right already is not the reason: then it is the call of create_timer.
    """
    timer = timers_of_lines(source)[0]
    if _is_made_again(source, timer):
        return Told(place_of(source, timer.call), "several")
    given = timer.period
    known = seconds_of(source, given) if given is not None else None
    if is_right(known, wanted):
        named = {"callback": timer.method} if timer.method else {}
        return Told(place_of(source, timer.call), "there", named)
    value = (value_of(source, given) or given) if given is not None else None
    code = _short_code(source, value)
    if value is None or not code:
        return Told(place_of(source, timer.call))
    variant = "number" if number_in(value) is not None else "expression"
    return Told(place_of(source, value), variant, {"code": code})


def _short_code(source: NodeSource, part: ast.expr | None) -> str:
    """Return the code of a part of a line; "" if it is long or has several lines."""
    code = source.module_of(part).text.code(part) if part is not None else ""
    return "" if "\n" in code or len(code) > LONGEST_CODE else code


def _is_made_again(source: NodeSource, timer: Timer) -> bool:
    """Whether there can be several timers: several calls, or one in a loop or in a callback."""
    around = list(source.module_of(timer.call).around(timer.call))
    looped = any(isinstance(part, ast.For | ast.While) for part in around)
    name = timer.function.name if timer.function is not None else ""
    several = name != "__init__" and len(source.calls_of(name)) > 1
    called = several or name in {t.method for t in source.timers}
    return len(timers_of_lines(source)) > 1 or looped or bool(name and called)
