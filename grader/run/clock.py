"""Virtual time: the node runs with `use_sim_time`, and this module drives its `/clock`.

After each `/clock` message a barrier proves that the node has run the callbacks that were due (two
round trips to its parameter service, docs/architecture.md). The measured period is therefore exact
on a busy machine too. A node without services is judged by `/clock` alone, with a short wait instead
of the barrier. Nodes that do not follow `/clock` are watched on the wall clock.
"""

from __future__ import annotations

import itertools
import statistics
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import pairwise

from grader.base.i18n.message import say
from grader.course.assignment import Output
from grader.run.observer import SECOND, Event, Observer, Watch, recurring
from grader.run.probe_link import Answer
from grader.sandbox.scheduling import Limit, seconds_waited

MILLISECOND = 1_000_000
BARRIER_SECONDS = 2.0  # of the run's time, for one barrier
SETTLE_SECONDS = 2.5  # of the run's time, within which a spinning node gives its first answer
OTHERS_SECONDS = 1.0  # of the run's time, for the other nodes' first answers, after one has come
QUIET_SECONDS = 0.03  # of the run's time, in which a node without services logs what was due
UNASKED_SECONDS = 2.0  # the same until a tick is missing
OTHER_LINE = 0.75  # of these that are left when a node has logged another line, and no more comes
SLOW_BARRIER = 0.2  # seconds of wall time; after a slower barrier a log record ends the next ones
UNANSWERED = 5  # unanswered barriers in a row after which the node counts as stuck
TRIES, TRY_SECONDS = 12, 0.5  # barriers and wall time after which a tick is missing
REAL = 0.97  # of real time: what keeps lines a whole period apart leaves out each second one
QUICK_STEP = 0.1  # seconds of wall time for a step after which a callback has not slept
MADE_UP = 0.05  # seconds of wall time by which a clock in real time may be late and make up for it
GRID = 20  # steps per period while the actual period is measured
MEASURED = 12  # periods of ROS time in which the actual period is measured
WALL_TICKS = 5
FEW = 4  # lines of a timer that is slower than the required one
FIRST_SECONDS = 0.5  # of it, in which a flood shows itself
WALL_SPARE = 3.0  # seconds of wall time in addition to the ticks'
MOST_AT_ONCE = 16  # lines of the count at one instant, after which the clock is no longer driven
STILL = 1.3  # periods of wall time without a /clock message, to detect a wall clock


class VirtualClock:
    """Drives `/clock` for one node and records which lines come when."""

    def __init__(
        self,
        observer: Observer,
        output: Output,
        *,
        deadline: float,
        fine: bool = False,
        grid: float = GRID,
        fine_ticks: int = 0,
        real_time: bool = False,
        more_ticks: int = 0,
        stay_until: float = 0,
    ) -> None:
        """Watch `more_ticks` beyond the announced ones, the last not before `stay_until`.

        A period has `grid` steps where the clock goes in `fine` steps, as it does before the last
        `fine_ticks` in any case, and where a period is measured. With `real_time` ROS time runs in
        `fine` steps and as fast as the wall clock.
        """
        self._fine = fine or real_time
        self._real_time = real_time
        self._run_clock = observer.run_clock
        self._set_at = 0.0  # by time.monotonic(): when the clock was set, if it is in real time
        self._ticks = output.ticks + more_ticks
        self._fine_from = self._ticks - fine_ticks
        self._stay_until = stay_until  # by time.monotonic()
        self._observer = observer
        self._output = output
        self._deadline = deadline  # by the run's clock
        self._at = 0
        self._before = 0
        self._unanswered = 0
        self._slow = False
        self._unasked = False  # whether no node has a service that can be asked
        self._late = 0  # ticks that came after their barrier
        self._piles_up = False  # whether many lines came at one instant, as if timers multiplied
        self._due: int | None = None
        self._due_at = -1
        self._period = round(output.period * SECOND)
        self._grid_step = max(round(self._period / grid), MILLISECOND)

    def drive(self, watch: Watch, on_event: Callable[[Event], None]) -> None:
        """Fill `watch`: check that one tick comes at each due instant and none 1 ms before it."""
        if not self._settle(watch) and not self._unasked:
            if self._over():
                return
            watch.note = say("the node does not answer: it is not spinning")
            self._watch_wall(watch, on_event)
            if watch.counted or not self._settle(watch):
                return
        watch.clock = "virtual"
        began = self._run_clock.now()
        found = self._at_due_instants(watch, self._period, on_event)
        if not found and not self._piles_up:
            self._find_period(watch, on_event)
        promptly = self._run_clock.now() - began < 0.5 * self._output.period * len(watch.dues)
        # a loop beside the node logs at any time: its lines only seem to be on time
        driven = not self._unasked and 2 * self._late <= len(watch.dues)
        if watch.missing or watch.early or not promptly or not driven or self._piles_up:
            self._unmask(watch, on_event)
        if not self._unasked and (self._is_stuck or not self._unanswered):
            watch.still_answers = not self._is_stuck

    def go_on(self, seconds: float) -> None:
        """Let ROS time pass without a barrier: the node is ending, and may need its next timer."""
        self._at += round(seconds * SECOND)
        self._observer.take(self._observer.probe.ask("clock", at=self._at, until_log=0, patient=0))

    def _settle(self, watch: Watch) -> bool:
        """Start the clock at 1 ms; return whether a node answers, that is, whether it spins.

        All nodes get time for their first answer; one that is not spun may stand beside another.
        """
        deadline = self._run_clock.now() + SETTLE_SECONDS
        while True:
            events, answer = self._ask(MILLISECOND, seconds=SETTLE_SECONDS / 10, patient=1)
            watch.before_start += events
            watch.events += events
            if answer.barrier is None:
                self._unasked = True
                return False
            now = self._run_clock.now()
            if answer.barrier and not watch.settled:
                watch.settled = True
                deadline = min(deadline, now + OTHERS_SECONDS)
            if (watch.settled and not answer.silent) or self._over() or now > deadline:
                return watch.settled

    def _at_due_instants(self, watch: Watch, phase: int, on_event: Callable[[Event], None]) -> bool:
        """Watch the due instants from `phase` on; return whether ticks came at these only."""
        already = len(watch.dues)
        lap: float | None = None
        for k in range(already, self._ticks):
            due = phase + (k - already) * self._period
            if k == self._ticks - 1 and self._stay_until:
                lap = None
                if not self._stay(watch):
                    return False
            early = self._go_to(due - MILLISECOND, fine=k >= self._fine_from)
            if lap is not None:
                held = self._run_clock.now() - lap
                watch.held.append(held if self._knows_the_node else 0.0)
            lap = None if self._fine else self._run_clock.now()
            watch.events += early
            if self._many_at(watch, k - 1):
                return False
            counts = any(event.n is not None for event in watch.events)
            found = self._wait_for_tick(due, k, counts=counts)
            watch.early += _ticks_among(early, found)
            self._due, self._due_at = k, due
            watch.dues.append(due / SECOND)
            watch.events += found
            for event in found:
                on_event(event)
            ticked = any(event.n is not None for event in found) if counts else bool(found)
            if not ticked:
                watch.missing.append(k)
            if not ticked or watch.early or self._over():
                return False
        return True

    def _many_at(self, watch: Watch, k: int) -> bool:
        """Whether so many lines came at a due instant that the next ones would take too long.

        Timers that multiply double their lines in each period; /rosout does not keep all of them.
        """
        at_once = sum(event.due == k and event.n is not None for event in watch.events)
        self._piles_up = at_once > MOST_AT_ONCE
        return self._piles_up

    def _stay(self, watch: Watch) -> bool:
        """Wait while the clock stands still; return whether no line of the count came."""
        left = self._stay_until - time.monotonic()
        left = min(left, self._deadline - self._run_clock.now())
        if left <= 0:
            return True
        still = self._observer.watch_for(left)
        watch.events += still
        kinds = {event.kind for event in watch.counted}
        watch.early += [event for event in still if event.kind in kinds]
        return not watch.early and not self._over()

    @cached_property
    def _knows_the_node(self) -> bool:
        """Whether the run's clock stands still while the node waits for a core."""
        return bool(self._observer.terminal.processes())

    def _go_to(self, at: int, *, fine: bool = False) -> list[Event]:
        """Set the clock to an instant, in one step or, if `fine`, in many.

        A node with faster timers loses some of their ticks when the clock jumps.
        """
        events: list[Event] = []
        if self._fine or fine:
            step = self._grid_step
            for between in range(self._at - self._at % step + step, at, step):
                if not self._over():
                    events += self._step(between)
        return events + self._step(at)

    def _wait_for_tick(self, due: int, k: int, *, counts: bool) -> list[Event]:
        """Step to a due instant and return the events; without a tick only after enough barriers.

        `counts` is whether a line of the expected form has come: then only such lines are ticks.
        """
        seconds = UNASKED_SECONDS if self._unasked else TRY_SECONDS
        limit = self._run_clock.limit(seconds, decides=self._unasked)
        found: list[Event] = []
        for attempt in itertools.count():
            events = self._step(due, wait=attempt > 0, until_log=True)
            self._late += bool(attempt and events and not found)
            found += [event if event.due is not None else replace(event, due=k) for event in events]
            if any(event.n is not None for event in found):
                break
            other = bool(found) and not counts
            if self._is_missing(attempt, limit, other=other) or self._over():
                break
        return found

    def _is_missing(self, attempt: int, limit: Limit, *, other: bool) -> bool:
        """Whether a tick is not there after so many barriers; after an `other` line it may follow."""
        if attempt < (TRIES / 4 if other else TRIES):
            return False
        proven = not self._unasked or limit.left < OTHER_LINE * UNASKED_SECONDS
        return (other and proven) or limit.over

    def _find_period(self, watch: Watch, on_event: Callable[[Event], None]) -> None:
        """Measure the period in small steps; if it is right, check the phase to 1 ms."""
        step, began = self._grid_step, self._run_clock.now()
        before = {id(event) for event in watch.before_start}
        seen: list[float] = [e.virtual for e in watch.counted if id(e) not in before]
        stop = self._at + MEASURED * self._period
        counts = any(event.n is not None for event in watch.events)
        lines: list[Event] = []
        fresh: list[float] = []
        while self._at < stop and len(fresh) < 6 and not self._over():
            events = self._step(self._at + step)
            watch.events += events
            for event in [e for e in events if e.n is not None] or events:
                on_event(event)
            lines += events
            fresh = [event.virtual for event in _ticks(lines, counts=counts)]
        different = {*seen, *fresh}
        if len(different) == 1:
            again = self._as_long_again(round(different.pop() * SECOND), step)
            watch.events += again
            fresh += [event.virtual for event in _ticks(again, counts=counts)]
        instants = sorted(set(fresh if len(fresh) > 2 else seen + fresh))
        if len(instants) in (2, 3):
            again = self._few_more([round(at * SECOND) for at in instants], step)
            watch.events += again
            more = {event.virtual for event in _ticks(again, counts=counts)}
            instants = sorted({*instants, *more})
        if len(instants) > 1:
            gaps = [b - a for a, b in zip(instants, instants[1:])]
            watch.period = statistics.median(gaps)
            quick = self._run_clock.now() - began < QUICK_STEP * len(lines)  # (a sleep is not)
            if quick and watch.period <= step / SECOND * 1.01 and step > MILLISECOND:
                watch.period = self._shorter(watch)
            tolerance = step / SECOND * 1.01
            if all(abs(gap - self._output.period) <= tolerance for gap in gaps) and len(fresh) > 2:
                self._verify_phase(watch, round(instants[-1] * SECOND), step, on_event)

    def _shorter(self, watch: Watch) -> float:
        """Return the period (s) of a node that logs in each step, measured in steps of 1 ms."""
        counts = any(event.n is not None for event in watch.events)
        lines: list[Event] = []
        stop = self._at + self._grid_step
        while self._at < stop and not self._over():
            lines += self._step(self._at + MILLISECOND)
        watch.events += lines
        instants = sorted({event.virtual for event in _ticks(lines, counts=counts)})
        gaps = [b - a for a, b in pairwise(instants)]
        return statistics.median(gaps) if gaps else self._grid_step / SECOND

    def _as_long_again(self, only: int, step: int) -> list[Event]:
        """Go on until the timer that made the only line would make another one; return what came."""
        events: list[Event] = []
        for at in (2 * only - step, 2 * only, 2 * only + step, 2 * only + self._period):
            if at > self._at and not events and not self._over():
                events += self._go_to(at)
        return events

    def _few_more(self, instants: list[int], step: int) -> list[Event]:
        """Go on until a slow timer has made FEW lines: with fewer, a wrong count may look right."""
        gap, last = instants[-1] - instants[-2], instants[-1]
        events: list[Event] = []
        for k in range(1, FEW + 1 - len(instants)):
            for at in (last + k * gap - step, last + k * gap, last + k * gap + step):
                if at > self._at and not self._over():
                    events += self._go_to(at)
        return events

    def _verify_phase(
        self, watch: Watch, last: int, step: int, on_event: Callable[[Event], None]
    ) -> None:
        """Find the phase to 1 ms and check the due instants again: the timer may be late."""
        events = self._go_to(last + self._period - step)
        watch.events += events
        at = self._at
        while at < last + self._period and not events and not self._over():
            at += MILLISECOND
            events = self._step(at)
            watch.events += events
        if not events:
            return
        kept = (watch.early, watch.missing, watch.dues)
        watch.early, watch.missing, watch.dues = [], [], []
        before = watch.events
        watch.events = []
        on_time = self._at_due_instants(watch, at + self._period, on_event)
        if on_time or (self._piles_up and not watch.early and not watch.missing):
            watch.period = self._output.period
            before = _without_dues(before)
        else:
            watch.early, watch.missing, watch.dues = kept
            watch.events = _without_dues(watch.events)
        watch.events = before + watch.events

    def _unmask(self, watch: Watch, on_event: Callable[[Event], None]) -> None:
        """Stop the clock for a while: lines that still come follow the wall clock.

        Before that, a callback that sleeps gets time to return: its lines are of the last instant.
        """
        if not self._unasked and not self._over():
            watch.events += self._step(self._at, wait=True)
        left = self._deadline - self._run_clock.now()
        seconds = min(left, STILL * self._output.period)
        still = self._observer.watch_still(seconds, decides=True)
        watch.events += still
        kinds = {event.kind for event in watch.counted}
        if any(event.kind in kinds for event in still) or (still and not watch.dues):
            watch.note = say("lines came while the ROS clock stood still")
            watch.period = None
            self._watch_wall(watch, on_event)

    def _watch_wall(self, watch: Watch, on_event: Callable[[Event], None]) -> None:
        """Watch a node that does not follow `/clock`."""
        watch_wall(self._observer, self._output, watch, on_event, deadline=self._deadline)

    def _step(self, at: int, *, wait: bool = False, until_log: bool = False) -> list[Event]:
        """Set the clock, make the barrier, and return the new events."""
        events, _ = self._ask(at, wait=wait, until_log=until_log)
        return events

    def _ask(
        self,
        at: int,
        *,
        wait: bool = False,
        until_log: bool = False,
        patient: int = 0,
        seconds: float = BARRIER_SECONDS,
    ) -> tuple[list[Event], Answer]:
        """Set the clock, make the barrier, and return the new events and the probe's answer."""
        observer = self._observer
        waited = self._wait_until_real(at)
        self._at = max(at, self._at)
        observer.now = self._at / SECOND
        published, limit = time.time(), self._run_clock.limit(seconds)
        began = self._run_clock.now()
        enough = int(until_log and self._slow)
        asked = {"at": self._at, "until_log": enough, "patient": patient}
        answer = observer.probe.ask("clock", seconds=seconds, **asked)
        self._slow |= not patient and self._run_clock.now() - began > SLOW_BARRIER
        events = waited + observer.take(answer, seconds=0.02 if wait else 0)
        events += observer.catch_up(answer.logs)
        while answer.barrier is False and not patient and not events and not limit.over:
            if observer.over:
                break
            answer = observer.probe.ask("clock", seconds=limit.rest, **asked)
            events += observer.take(answer) + observer.catch_up(answer.logs)
        # a missing tick is waited for: this limit proves nothing
        quiet = self._run_clock.limit(QUIET_SECONDS, decides=False)
        while self._unasked and not quiet.over:
            still = observer.probe.ask("wait", seconds=QUIET_SECONDS)
            events += observer.take(still) + observer.catch_up(still.logs)
        events = self._at_their_instants(events, published)
        silent = answer.barrier is False and not events
        self._unanswered = self._unanswered + 1 if silent else 0
        self._before = self._at
        if answer.clocks > 1:
            raise ForeignClock(events)
        return events, answer

    def _wait_until_real(self, at: int) -> list[Event]:
        """Wait until an instant has come on the wall clock too; return what came meanwhile."""
        if not self._real_time or at <= self._at:
            return []
        began = time.monotonic()
        wanted = max(self._set_at, began - MADE_UP) + REAL * (at - self._at) / SECOND
        self._set_at = wanted if self._at else began
        left = self._deadline - self._run_clock.now()
        return self._observer.watch_for(min(self._set_at - began, left))

    def _at_their_instants(self, events: list[Event], published: float) -> list[Event]:
        """Assign events from before this step's clock message to the previous instant."""
        due = self._due if self._before == self._due_at else None
        return [
            replace(event, virtual=self._before / SECOND, due=due)
            if event.record is not None and event.wall < published and self._before
            else event
            for event in events
        ]

    @property
    def _is_stuck(self) -> bool:
        """Whether the node no longer answers."""
        return self._unanswered >= UNANSWERED and self._at > MILLISECOND

    def _over(self) -> bool:
        return self._is_stuck or self._observer.over or self._run_clock.now() > self._deadline


def _without_dues(events: Sequence[Event]) -> list[Event]:
    """Return events of a try whose due instants do not count."""
    return [event if event.due is None else replace(event, due=None) for event in events]


def _ticks(events: Sequence[Event], *, counts: bool) -> Sequence[Event]:
    """Return the lines of the count: of the expected form, else those that recur, else all.

    Only those of the expected form if the node `counts`, that is, if one has come before.
    """
    own = [event for event in events if event.n is not None]
    if counts:
        return own
    return own or recurring(events, on_wall=False) or events


def _ticks_among(early: Sequence[Event], found: Sequence[Event]) -> list[Event]:
    """Return the lines before a due instant that belong to the count, as those found at it do."""
    if any(event.n is not None for event in (*early, *found)):
        return [event for event in early if event.n is not None and event.due is None]
    kinds = {event.kind for event in found}
    return [event for event in early if event.kind in kinds and event.due is None]


class ForeignClock(Exception):  # noqa: N818
    """Another node publishes `/clock` too, so that virtual time measures nothing."""

    def __init__(self, events: list[Event]) -> None:
        super().__init__("foreign clock")
        self.events = events


def watch_wall(
    observer: Observer,
    output: Output,
    watch: Watch,
    on_event: Callable[[Event], None],
    *,
    deadline: float,
) -> None:
    """Watch a fixed number of ticks on the wall clock; the period is the median of the gaps.

    The lines of before, which may have come on a faster clock, only belong to the count.
    """
    watch.clock = "wall"
    watch.dues, watch.missing, watch.early = [], [], []
    watch.events = _without_dues(watch.events)
    began, now = time.time(), observer.run_clock.now()
    end = min(deadline, now + (WALL_TICKS + 1) * output.period + WALL_SPARE)
    node = observer.terminal.processes()
    waited, quiet = seconds_waited(node), now
    first = observer.watch_still(min(end - now, FIRST_SECONDS))
    watch.events += first
    if any(event.wall >= began for event in watch.counted):
        quiet = observer.run_clock.now()
    for event in first:
        on_event(event)
    while observer.run_clock.now() < end and not observer.over:
        fresh = [event for event in watch.counted if event.wall >= began]
        if len(fresh) > WALL_TICKS and any(e.n is not None for e in watch.events):
            break
        events = observer.take(observer.probe.ask("wait", seconds=0.05))
        watch.events += events
        if len([e for e in watch.counted if e.wall >= began]) > len(fresh):
            quiet = observer.run_clock.now()
        for event in events:
            on_event(event)
    waited = seconds_waited(node) - waited
    watch.events += observer.settle()
    watch.events.sort(key=lambda event: event.wall)
    stamps = [event.wall for event in watch.counted if event.wall >= began]
    if not observer.terminal.ended:
        watch.silent = observer.run_clock.now() - quiet
    if len(stamps) > 2:
        observer.slack = waited / (len(stamps) - 1)
        watch.period = statistics.median(b - a for a, b in zip(stamps, stamps[1:]))
