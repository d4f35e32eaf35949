"""One use of a kind of check in an assignment: its parameters, run, node and window of time."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

from grader.base.i18n.message import say
from grader.course.assignment import CheckUse
from grader.course.scenario import RunPlan
from grader.report.model import Where
from grader.run.observations import End, Message, Observations, Role
from grader.run.programs import full_name
from grader.run.run import Run
from grader.verdict.checks.declare import EDGE, Parameters
from grader.verdict.checks.faults import node_file
from grader.verdict.checks.own_interface import fault_of_type
from grader.verdict.checks.spinning import is_spun
from grader.verdict.evidence import Evidence
from grader.verdict.node_files import source_of_node
from grader.verdict.outcome import Blocked, Inconclusive

P_co = TypeVar("P_co", bound=Parameters, covariant=True)
T = TypeVar("T")
SERVICE_TOPICS = ("/rosout", "/parameter_events", "/clock")


@dataclass(frozen=True)
class Use(Generic[P_co]):
    """A use of a check; all times are seconds of ROS time."""

    use: CheckUse
    given: P_co
    evidence: Evidence

    @property
    def plan(self) -> RunPlan:
        """The plan of the run that is judged."""
        return self.evidence.assignment.plan(self.evidence.run_name or self.use.run)

    @property
    def in_scenario(self) -> bool:
        """Whether a scenario's run is judged; the run of schema 1 is driven line by line."""
        return bool(self.evidence.assignment.runs)

    @property
    def observed(self) -> Run:
        """The run that is judged, also if its nodes did not start."""
        if not self.in_scenario:
            return self.evidence.run
        package = self.evidence.assignment.package
        if package != self.evidence.asked.package:
            self.blocked_by("package.beside", package=package)
        return self.evidence.run

    @property
    def run(self) -> Run:
        """A scenario's run that is judged. Raises Blocked if its node did not start, or does not spin."""
        run = self.observed
        if not run.started:
            raise Blocked(by="run.starts")
        if not run.ended_by_itself and not is_spun(run):
            raise Blocked(by="run.spins")
        return run

    @property
    def whole_run(self) -> Run:
        """The same run with the nodes of all its programs."""
        return self.evidence.run_of(self.run.name) if self.in_scenario else self.run

    @property
    def seen(self) -> Observations:
        """What that run showed. Raises Failed if the check needs a type that could not be used."""
        seen = self.run.seen
        assert seen is not None
        for name in self._types if seen.unusable else ():
            if name in seen.unusable:
                raise fault_of_type(self.evidence, name, seen.unusable[name])
        return seen

    @property
    def _types(self) -> list[str]:
        """The types that the check needs: its own, its topic's, and that of what it comes after."""
        own = getattr(self.given, "type", "")
        topic = self.plan.topics.get(getattr(self.given, "topic", ""), "")
        before = self.plan.stimulus(self.use.after)
        return [own, topic, *(one.type for one in (before.typed if before else {}).values())]

    @property
    def wanted(self) -> str:
        """The full name that the node that is judged must have."""
        return full_name(self.evidence.assignment, self.plan.start[self.evidence.start])

    @property
    def node(self) -> str:
        """The full name of the node that is judged: that of `of`, else the run's first."""
        names = [node.name for node in self.run.nodes]
        return names[0] if len(names) == 1 else self.wanted  # its name is another check's matter

    @property
    def end(self) -> float:
        """The last instant that the run reached."""
        return self.seen.instants[-1] if self.seen.instants else 0.0

    @property
    def window(self) -> tuple[float, float]:
        """The first and the last instant that count. Raises Inconclusive if it was not reached."""
        begin = 0.0
        if self.use.after:
            done = self.seen.stimulus(self.use.after)
            if done is None:
                raise self.unreached()
            begin = done.at
        if self.use.during is None:
            return begin, max(begin, self.plan.clock.period * self.plan.clock.ticks)
        first, last = self.use.during
        return begin + first, begin + last

    def unreached(self) -> Blocked | Inconclusive:
        """Return the outcome of a window that the run did not reach."""
        if self.run.ended_by_itself or self.run.resource or self.run.flooded:
            return Blocked(by="run.stays")
        if self.seen.stuck is not None:
            return Blocked(by="run.stays")
        return Inconclusive(say("the run did not reach this instant in its time limit"))

    def require_window(self) -> tuple[float, float]:
        """Return the window; raises Blocked or Inconclusive unless the run reached its end."""
        first, last = self.window
        if self.end < last - EDGE:
            raise self.unreached()
        return first, last

    def in_window(self, items: Iterable[T], at: Callable[[T], float]) -> list[T]:
        """Return what came in the window; `at` returns when something came."""
        first, last = self.window
        return [item for item in items if first - EDGE <= at(item) <= last + EDGE]

    def blocked_by(self, *kinds: str, **given: str) -> None:
        """Raise Blocked if a check of one of these kinds has failed, with the parameters `given`."""
        for other in self.evidence.assignment.checks:
            same = all(other.with_.get(name) == value for name, value in given.items())
            if same and other.kind in kinds and self.evidence.has_failed(other.id):
                raise Blocked(by=other.id)

    def blocked_by_call(self, name: str) -> None:
        """Raise Blocked if the stimulus of that name calls a service that is not offered."""
        stimulus = self.plan.stimulus(name)
        if stimulus is not None and stimulus.call is not None:
            self.blocked_by("service.offers", service=stimulus.call.service)

    def messages(self, topic: str) -> list[Message]:
        """Return the messages of a topic in the window."""
        return self.in_window(self.seen.of_topic(topic), lambda message: message.at)

    def ends(self, role: Role, *, own: bool = True) -> list[End]:
        """Return the ends of a role, those of the judged node if `own`; not ROS's own topics."""
        return [
            end
            for end in self.seen.ends
            if end.role == role
            and (not own or end.node == self.node)
            and end.name not in SERVICE_TOPICS
        ]

    def call(self, *names: str, mentions: str = "") -> Where:
        """Return the line of the node's first call of one of these names, else the node's file.

        A call with the text `mentions` among its arguments comes before the others.
        """
        source = source_of_node(self.evidence)
        found = source.calls_of(*names) if source is not None else []
        if source is None or not found:
            return node_file(self.evidence)
        best = _best(found, mentions)
        return Where(file=source.module_of(best).path, line=best.lineno)


def _best(found: Sequence[ast.Call], mentions: str) -> ast.Call:
    """Return the call with a text among its arguments, else the first."""
    wanted = mentions.strip("/")
    return next((one for one in found if wanted and wanted in ast.unparse(one)), found[0])
