"""A marking session: one opened sandbox with a probe in it, in which one package is built and run."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from types import TracebackType

from grader.base.unheard import unheard
from grader.course.assignment import Assignment
from grader.package.submission import Submission
from grader.run.observer import Event
from grader.run.probe_link import ProbeError, ProbeLink
from grader.run.run import Run, observe
from grader.run.workspace import Build, build
from grader.sandbox.base import Sandbox
from grader.sandbox.proof import prove_again

WORKS_SECONDS = 10.0
RUNS = 3  # how often a run is tried when our own side fails
AGREE = 0.1  # of the period: two runs on the wall clock that differ by more say nothing


class Unobserved(Exception):  # noqa: N818 - it says nothing about the node
    """Our own side kept us from seeing what the node does."""


class Session:
    """Builds and runs one package in an opened sandbox; `timing` has the seconds of each stage.

    All of it has the limits' `verdict_seconds`: nothing is begun, or begun again, for which what is
    left of them has no room.
    """

    def __init__(self, sandbox: Sandbox, assignment: Assignment) -> None:
        self.sandbox = sandbox
        self.assignment = assignment
        self.timing = {"build": 0.0, "run": 0.0}
        self._probe: ProbeLink | None = None
        self._ceiling = time.monotonic() + sandbox.limits.verdict_seconds

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
        """Build the package; the probe starts up beside it, on another core.

        Raises BrokenRosError if it is colcon that does not run.
        """
        begin = time.monotonic()
        self._probe = self._probe or ProbeLink(self.sandbox)
        try:
            made = build(self.sandbox, submission, package=self.assignment.package)
            if made.doubts_colcon:
                prove_again(self.sandbox)
        finally:
            self.timing["build"] += time.monotonic() - begin
        return replace(made, stopped_by=made.stopped_by or self._resource(made.status))

    def run(self, tell: Callable[[Event], None]) -> Run:
        """Run the node; a run that our own side spoilt is repeated; Unobserved if all were.

        A run that would cost points for its timing is repeated too, with the clock in fine steps:
        neither the load of the machine nor a jump of the clock may look like the node's fault. What
        the verdict's ceiling leaves no time for is not repeated.
        Raises BrokenRosError if it is ros2 that does not run.
        """
        begin = time.monotonic()
        try:
            run = self._run(tell)
            if run.doubts_ros2:
                prove_again(self.sandbox)
            if self._doubtful(run):
                # the ticks of a second run are not reported: the listener has heard them once
                run = self._second_opinion(run, self._run(unheard, fine=True))
            return run
        finally:
            self.timing["run"] += time.monotonic() - begin

    def _run(self, tell: Callable[[Event], None], *, fine: bool = False) -> Run:
        failure: ProbeError | None = None
        tries = 0
        while tries < RUNS and self._has_room():
            tries += 1
            self._probe = self._probe or ProbeLink(self.sandbox)
            until = min(time.monotonic() + self.sandbox.limits.max_run_seconds, self._ceiling)
            try:
                run = observe(
                    self.sandbox, self.assignment, self._probe, tell, until=until, fine=fine
                )
            except ProbeError as error:
                failure = error
                self._drop_probe()
                continue
            run.resource = run.resource or self.sandbox.resource_limit_hit()
            if run.ended_by_itself and not run.nodes and not run.resource and not self._works():
                failure = ProbeError(f"the sandbox starts no command any more:\n{run.transcript}")
                continue
            return run
        if failure is None:
            raise Unobserved("the verdict's time was used up, and a run would not have fitted in")
        prove_again(self.sandbox)
        raise Unobserved(f"the probe failed in {tries} of {tries} runs, the last time: {failure}")

    def _works(self) -> bool:
        """Whether a command that does nothing succeeds: that one ended at once is the node's then."""
        return self.sandbox.run(["true"], seconds=WORKS_SECONDS).status == 0

    def _has_room(self) -> bool:
        """Whether the verdict's ceiling leaves time for a whole run."""
        return self._ceiling - time.monotonic() >= self.sandbox.limits.max_run_seconds

    def _doubtful(self, run: Run) -> bool:
        """Whether load could have made this run look worse than the node is."""
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
        return run.watch.period is None or abs(run.watch.period - wanted) <= 0.05 * wanted

    def _second_opinion(self, first: Run, second: Run) -> Run:
        if first.watch.clock == second.watch.clock == "virtual":
            return second if self._on_time(second) else first
        if not second.nodes or self._on_time(second):
            return second
        before, after = first.watch.period or 0.0, second.watch.period or 0.0
        second.inconsistent = abs(before - after) > AGREE * self.assignment.output.period
        return second

    def _resource(self, status: int | None) -> str:
        return self.sandbox.resource_limit_hit() if status not in (0, None) else ""

    def _drop_probe(self) -> None:
        probe, self._probe = self._probe, None
        if probe is not None:
            probe.close()
