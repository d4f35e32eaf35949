"""A marking session: builds and runs one package in an open sandbox with a probe in it."""

from __future__ import annotations

import re
import statistics
import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from types import TracebackType

from grader.base.unheard import unheard
from grader.course.assignment import Assignment
from grader.course.scenario import RunPlan
from grader.package.source.command_line import reads_command_line
from grader.package.source.ends_after import counts_to, ends_after
from grader.package.source.real_time import reads_real_time
from grader.package.source.remarks import remarks_on
from grader.package.source.ros_time import waits_for_ros_time
from grader.package.source.telling import could_tell
from grader.package.source.timer_periods import TimerPeriods, timer_periods
from grader.package.submission import Submission
from grader.run.changed_build import BuiltPackage, changed_modules, with_changes
from grader.run.clock import GRID
from grader.run.conduct import conduct
from grader.run.observer import Event
from grader.run.plain_run import Early, early, happens
from grader.run.probe_link import ProbeError, ProbeLink
from grader.run.programs import full_name
from grader.run.run import WALL_TOLERANCE, Run, counts_plainly, observe
from grader.run.student_interfaces import interfaces_of
from grader.run.unforeseen import Unforeseen, unforeseen
from grader.run.workspace import BUILD, Build, build, restore, save
from grader.sandbox.base import LOAD, Sandbox
from grader.sandbox.proof import prove_again
from grader.sandbox.scheduling import StarvedError

WORKS_SECONDS = 10.0
BUSY = "the machine was too busy: mark it again when less runs beside it"
LEAST_HELD = 3  # steps
REFUSED = {
    "memory": re.compile(r"MemoryError|bad_alloc|Cannot allocate memory"),
    "processes": re.compile(r"Resource temporarily unavailable|can't start new thread"),
}
LAST_OUTPUT = 20_000  # characters, in which a program says why it ended
SAMPLE = 0.05  # of the packages without a remark are run plainly too
CONFIRMING_RUNS = 2  # before a node counts as one that works only while it is marked
PATIENCE = 3.0  # times the wall time that the first line took, for those of a plain run
PLAIN_SECONDS = 5.0  # of wall time on top of that
RUNS = 3  # attempts at a run if our own side fails
FASTEST = 1000  # steps of the clock in a second of ROS time
FINE_TICKS = 2  # last lines before which the clock goes in fine steps, if a period is not known
AGREE = 0.1  # of the period: two runs on the wall clock that differ by more are inconsistent


class Unobserved(Exception):  # noqa: N818 - not an error of the node
    """Our own side failed, so that the node could not be observed."""


def _lines(run: Run, plan: RunPlan, named: Assignment) -> list[tuple[str, float]]:
    """Return the logger and the instant of each line of a plan's own nodes."""
    own = {full_name(named, one).strip("/").replace("/", ".") for one in plan.start}
    records = [(one.record.name, one.virtual) for one in run.watch.events if one.record]
    return [one for one in records if one[0] in own]


class Session:
    """Builds and runs one package in an open sandbox; `timing` has the seconds of each stage.

    A session may take the limits' `verdict_seconds`, or until `deadline` (of the run's clock); a
    run that does not fit into what is left of them is not started. `note` is told of faults of ours
    that cost no check. `like` is a built package from which this one may differ in modules only. The
    package is `built` after a build that is to be kept.
    """

    def __init__(
        self,
        sandbox: Sandbox,
        assignment: Assignment,
        *,
        deadline: float | None = None,
        note: Callable[[str], None] = unheard,
        like: BuiltPackage | None = None,
        is_kept: bool = False,
    ) -> None:
        self._note = note
        self._like, self._is_kept = like, is_kept
        self.built: BuiltPackage | None = None
        self.sandbox = sandbox
        self.assignment = assignment
        self.run_clock = sandbox.run_clock
        self.deadline = deadline or self.run_clock.now() + sandbox.limits.verdict_seconds
        self.timing = {"build": 0.0, "run": 0.0}
        self._probe: ProbeLink | None = None
        self._interfaces = b""  # those of the submission, for the probe
        self._could_tell = False  # that it is marked
        self._reads_real_time = False
        self._reads_command_line = False
        self._waits_for_ros_time = False
        self._periods = TimerPeriods()
        self._unforeseen = Unforeseen(more_ticks=0, stay_seconds=0, draw=1)
        self._built = b""  # the workspace after the build, for a plain run or another scenario
        self._run_plainly = set[str]()  # the nodes of a scenario of which there was a plain run
        self._planned = False  # whether a run of a scenario was made

    def __enter__(self) -> Session:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._drop_probe()
        self.sandbox.close()

    def build(self, submission: Submission) -> Build:
        """Build the package; the probe starts meanwhile, on another core.

        Raises BrokenRosError if colcon itself does not run.
        """
        begin = time.monotonic()
        try:
            self._find_interfaces(submission)
        except StarvedError:
            return Build(BUILD, None, "", time.monotonic() - begin, stopped_by=LOAD)
        self._probe = self._probe or self._new_probe()
        try:
            self._read_sources(submission)
        except Exception as fault:  # a bug of ours must not lose the build
            self._note(f"the sources were not read because of a fault of ours: {fault!r}")
        try:
            made = self._build(submission)
            if made.doubts_colcon:
                prove_again(self.sandbox)
            several = self._is_confirmed() or len(self.assignment.runs) > 1
            if made.status == 0 and (several or self._is_kept):
                self._built = save(self.sandbox)
            if self._is_kept:
                more = (self._built, self.sandbox.overlay, self.sandbox.workspace, self._interfaces)
                self.built = BuiltPackage(submission, made, *more)
        finally:
            self.timing["build"] += time.monotonic() - begin
        stopped_by = made.stopped_by or self._resource(made.status)
        if not stopped_by and made.status != 0:
            stopped_by = self._limit_on_a_process(made.log)
        return replace(made, stopped_by=stopped_by)

    def _find_interfaces(self, submission: Submission) -> None:
        """Make the submission's interfaces for the probe, before the student's code runs."""
        if self._like is not None and changed_modules(self._like, submission):
            self._interfaces = self._like.interfaces
        elif submission.packages:
            self._interfaces = interfaces_of(self.sandbox, submission)

    def _build(self, submission: Submission) -> Build:
        package = self.assignment.package
        if self._like is not None:
            made = with_changes(self._like, submission, self.sandbox, package=package)
            if made is not None:
                return made
        made = build(self.sandbox, submission, package=package)
        return build(self.sandbox, submission, package=package) if made.stopped_by == LOAD else made

    def _read_sources(self, submission: Submission) -> None:
        """Read from the sources how the node is best observed."""
        others = [file for one in submission.packages for file in one.files]
        self._could_tell = could_tell([*submission.files, *others])
        self._reads_real_time = reads_real_time(submission.files)
        self._reads_command_line = reads_command_line(submission.files)
        self._waits_for_ros_time = waits_for_ros_time(submission.files)
        self._periods = timer_periods(submission.files)
        could_end = any(one.kind in ("ends", "hides") for one in remarks_on(submission.files))
        self._unforeseen = unforeseen(
            submission.sha256,
            could_end=could_end,
            ends_after=ends_after(submission.files),
            counts_to=0 if self._reads_real_time else counts_to(submission.files),
        )

    def run(self, on_event: Callable[[Event], None], *, named: Assignment | None = None) -> Run:
        """Run the node and return the result; repeat the run if our own side failed.

        `named` is the assignment with the names that the built package has, if they differ.
        The clock goes in fine steps from the beginning if the node has a timer that is faster than
        the lines: a jump of the clock leaves out calls of it, and may make wrong lines look right.
        If the period of a timer is not known, it goes so before the last lines.
        A run that would cost points for its timing is repeated too, with the clock in fine steps,
        because load or a jump of the clock must not look like the node's fault; with a clock as fast
        as the wall clock, if the package reads that. A package that reads its command line gets a run
        without our arguments, if it does not count with them; so does a node that never spins and
        waits for its clock. A run is repeated only if the verdict's
        time limit leaves time for it.
        Raises Unobserved if our own side failed each time, BrokenRosError if ros2 itself does not
        run.
        """
        begin = time.monotonic()
        named = named or self.assignment
        try:
            run = self._run(on_event, named, fine=self._has_faster_timer)
            if run.doubts_ros2:
                prove_again(self.sandbox)
            return self._compared(run, named)
        finally:
            self.timing["run"] += time.monotonic() - begin

    def run_plan(
        self, plan: RunPlan, on_event: Callable[[Event], None], *, named: Assignment | None = None
    ) -> Run:
        """Make one run of a scenario, in the workspace as it was built; raises as `run` does."""
        begin = time.monotonic()
        named = named or self.assignment
        try:
            if self._planned:
                restore(self.sandbox, self._built)
            self._planned = True
            observed = partial(conduct, self.sandbox, named, plan, timers=self._periods)
            run = self._observed(observed, on_event)
            if run.doubts_ros2:
                prove_again(self.sandbox)
            nodes = {begin.node for begin in plan.start}
            if self._could_tell and run.seen is not None and not nodes <= self._run_plainly:
                wanted = early(plan, run.seen, _lines(run, plan, named))
                if wanted is not None:
                    run.confirmed = self._happens_plainly(plan, named, wanted)
                    self._run_plainly |= nodes
            return run
        finally:
            self.timing["run"] += time.monotonic() - begin

    def _happens_plainly(self, plan: RunPlan, named: Assignment, wanted: Early) -> bool | None:
        """Return whether it happens in a plain run too; False only after two that show it."""

        def happened() -> bool:
            probe = self._new_probe()
            try:
                return happens(self.sandbox, named, plan, probe, wanted, until=self._until)
            finally:
                probe.close()

        try:
            return self._works_plainly(happened)
        except ProbeError:
            return None

    def _compared(self, run: Run, named: Assignment) -> Run:
        """Return a run after another one, if one run does not say enough about the node."""
        # the second run reports no ticks: the listener already has those of the first
        if self._reads_command_line and not self._begins_right(run):
            plain = self._run(unheard, named, plain=True)
            died = run.ended_by_itself and not run.watch.counted
            return plain if died or self._begins_right(plain) else run
        if self._waits_for_ros_time and self._stands_still(run):
            plain = self._run(unheard, named, plain=True)
            return plain if len(plain.watch.counted) > len(run.watch.counted) else run
        if self._holds_up(run):
            again = self._run(unheard, named)
            if self._holds_up(again):
                run.held_up = statistics.median([*run.watch.held, *again.watch.held])
            elif again.watch.counted and self._on_time(again):
                return again
        elif self._doubtful(run) and self._reads_real_time:
            return self._run(unheard, named, real_time=True)
        elif self._doubtful(run):
            return self._second_opinion(run, self._run(unheard, named, fine=True))
        elif self._may_only_work_here(run):
            run.confirmed = self._confirm(run, named)
        return run

    def _run(
        self,
        on_event: Callable[[Event], None],
        named: Assignment,
        *,
        fine: bool = False,
        real_time: bool = False,
        plain: bool = False,
    ) -> Run:
        observed = partial(
            observe,
            self.sandbox,
            named,
            fine=fine,
            grid=self._grid,
            fine_ticks=0 if self._periods.are_known else FINE_TICKS,
            real_time=real_time,
            plain=plain,
            more_ticks=self._unforeseen.more_ticks,
            stay_seconds=self._unforeseen.stay_seconds,
        )
        return self._observed(observed, on_event)

    def _observed(self, observed: Callable[..., Run], on_event: Callable[[Event], None]) -> Run:
        """Return a run, made again if our own side fails."""
        failure: ProbeError | None = None
        tries = 0
        while tries < RUNS and self._has_time():
            tries += 1
            self._probe = self._probe or self._new_probe()
            self.run_clock.starved = False
            try:
                run = observed(self._probe, on_event, until=self._until)
                if self.run_clock.starved:
                    raise ProbeError(BUSY)
            except ProbeError as error:
                failure = error
                continue
            finally:
                self._drop_probe()  # a run never shares a network with an earlier one
            run.resource = run.resource or self.sandbox.resource_limit_hit()
            if run.ended_by_itself and not run.resource:
                run.resource = self._limit_on_a_process(run.transcript)
            if run.ended_by_itself and not run.nodes and not run.resource and not self._works():
                failure = ProbeError(f"the sandbox no longer starts commands:\n{run.transcript}")
                continue
            return run
        if failure is None:
            raise Unobserved("the verdict's time limit left no time for a run")
        if str(failure) == BUSY:
            raise Unobserved(BUSY)
        prove_again(self.sandbox)
        raise Unobserved(f"the probe failed in all {tries} runs, the last time: {failure}")

    @property
    def _has_faster_timer(self) -> bool:
        """Whether a timer of the node is faster than the lines."""
        fastest = self._periods.fastest
        return fastest is not None and fastest < self.assignment.output.period

    @property
    def _grid(self) -> float:
        """The fine steps of a period, in which no timer of the node loses a tick.

        A timer fires once in a step, however long that is; the fastest steps are of 1 ms.
        """
        period = self.assignment.output.period
        fastest = self._periods.fastest
        if fastest is None or fastest >= period / GRID:
            return GRID
        return min(period / fastest, period * FASTEST)

    def _stands_still(self, run: Run) -> bool:
        """Whether a node never answered, still runs, and has at most one line of a count.

        If its loop waits for its clock, it counts on the wall clock, where a person runs it.
        """
        answered = run.watch.settled or any(node.answers for node in run.nodes)
        over = run.ended_by_itself or run.flooded or bool(run.resource)
        return bool(run.nodes) and not answered and not over and len(run.watch.counted) <= 1

    def _holds_up(self, run: Run) -> bool:
        """Whether callbacks took longer than a period: ROS time waits for them, a person does not.

        Half of the steps must have, and at least three: one slow step proves nothing.
        """
        slow = [held for held in run.watch.held if held > self.assignment.output.period]
        return len(slow) >= max(LEAST_HELD, len(run.watch.held) / 2)

    def _may_only_work_here(self, run: Run) -> bool:
        """Whether to see if the node also works without our arguments, as a person runs it."""
        if not self._begins_right(run) or not self._on_time(run):
            return False  # (it has failed already)
        return self._is_confirmed()

    def _begins_right(self, run: Run) -> bool:
        """Whether a node counts from the start, and did not end by itself."""
        output = self.assignment.output
        begin = [event.n for event in run.watch.counted[:2]]
        return begin == [output.start, output.start + output.step] and not run.ended_by_itself

    def _is_confirmed(self) -> bool:
        """Whether the package is run plainly too, if it counts."""
        if self.assignment.confirm != "sample":
            return self.assignment.confirm == "always"
        return self._could_tell or self._unforeseen.draw < SAMPLE

    def _confirm(self, run: Run, named: Assignment) -> bool | None:
        """Return whether the node counts in a plain run too; False only after two that show it.

        Each begins in the workspace as it was built, so that an earlier run cannot prepare it. The
        first line of `run` tells how long this machine needs for it now.
        """
        slow = PATIENCE * (run.first_line_seconds or self.sandbox.limits.start_seconds)
        patience = 2 * named.output.period + PLAIN_SECONDS + slow
        return self._works_plainly(
            partial(counts_plainly, self.sandbox, named, patience=patience, until=self._until)
        )

    def _works_plainly(self, works: Callable[[], bool]) -> bool | None:
        """Return what plain runs show; None if the machine was too busy, or left no time."""
        tries = 0
        while tries < CONFIRMING_RUNS and self._has_time():
            clean = not self._built or restore(self.sandbox, self._built)
            self.run_clock.starved = False
            if clean and works():
                return True
            if self.run_clock.starved:
                return None
            tries += 1
        return False if tries == CONFIRMING_RUNS else None

    def _works(self) -> bool:
        """Whether a command that does nothing succeeds; if so, the node ended by itself."""
        return self.sandbox.run(["true"], seconds=WORKS_SECONDS).status == 0

    def _has_time(self) -> bool:
        """Whether the verdict's time limit leaves time for a whole run."""
        return self.deadline - self.run_clock.now() >= self.sandbox.limits.max_run_seconds

    @property
    def _until(self) -> float:
        """When a run that begins now ends at the latest, by the run's clock."""
        longest = self.run_clock.now() + self.sandbox.limits.max_run_seconds
        return min(longest, self.deadline)

    def _doubtful(self, run: Run) -> bool:
        """Whether load of the machine may have made this run look worse than the node is."""
        if run.ended_by_itself or run.flooded or run.resource:
            return False
        unseen = not run.nodes and bool(run.watch.counted)
        return unseen or (bool(run.watch.counted) and not self._on_time(run))

    def _on_time(self, run: Run) -> bool:
        if run.watch.clock == "virtual":
            return not run.watch.missing and not run.watch.early
        return self._period_holds(run)

    def _period_holds(self, run: Run) -> bool:
        wanted = self.assignment.output.period
        tolerance = WALL_TOLERANCE * wanted
        return run.watch.period is None or abs(run.watch.period - wanted) <= tolerance

    def _second_opinion(self, first: Run, second: Run) -> Run:
        if first.watch.clock == second.watch.clock == "virtual":
            return second if self._on_time(second) else first
        if not second.nodes or self._on_time(second):
            return second
        before, after = first.watch.period or 0.0, second.watch.period or 0.0
        second.inconsistent |= abs(before - after) > AGREE * self.assignment.output.period
        return second

    def _resource(self, status: int | None) -> str:
        return self.sandbox.resource_limit_hit() if status not in (0, None) else ""

    def _limit_on_a_process(self, output: str) -> str:
        """Return the limit that output names, if it is one on each process ("" if none is).

        The kernel counts no such refusals: the program is told, and dies of its own error.
        """
        held_by = self.sandbox.held_by()
        for limit, error in REFUSED.items():
            if held_by.get(limit) == "rlimit" and error.search(output[-LAST_OUTPUT:]):
                return limit
        return ""

    def _new_probe(self) -> ProbeLink:
        more = {"interfaces": self._interfaces} if self._interfaces else {}
        return ProbeLink(self.sandbox, **more)

    def _drop_probe(self) -> None:
        probe, self._probe = self._probe, None
        if probe is not None:
            probe.close()
