"""One use of a kind of check in an assignment: its parameters, run, node and window of time."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Generic, TypeVar

from grader.base.i18n.message import say
from grader.course.assignment import CheckUse
from grader.course.scenario import RunPlan
from grader.course.worlds import is_of_world
from grader.package.source.names import dotted
from grader.report.model import Where
from grader.run.names_of_ros import ACTION, TOPICS, is_of_ros
from grader.run.observations import OURS, UNKNOWN, End, Message, Observations, Role
from grader.run.programs import full_name, names_of
from grader.run.run import Run
from grader.verdict.checks.faults import call_in
from grader.verdict.checks.own_interface import fault_of_type
from grader.verdict.checks.parameters import EDGE, Parameters
from grader.verdict.evidence import Evidence
from grader.verdict.node_files import source_of_node
from grader.verdict.outcome import Blocked, Inconclusive

P_co = TypeVar("P_co", bound=Parameters, covariant=True)
T = TypeVar("T")


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
    def run(self) -> Run:
        """A scenario's run that is judged. Raises Blocked if its node did not start, or does not spin."""
        run = self.evidence.run
        if not run.started:
            raise Blocked(by="run.starts")
        if not run.ended_by_itself and not run.is_spun:
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

    def blocked_by(self, *kinds: str, of: str | None = None, **given: str) -> None:
        """Raise Blocked if a check of one of these kinds has failed, with the parameters `given`.

        `of` is the node that it must name ("" for none), None for any.
        """
        for other in self.evidence.assignment.checks:
            same = all(other.with_.get(name) == value for name, value in given.items())
            same = same and of in (None, other.of)
            if same and other.kind in kinds and self.evidence.has_failed(other.id):
                raise Blocked(by=other.id)

    def blocked_by_call(self, name: str) -> None:
        """Raise Blocked if the stimulus of that name calls a service that is not offered."""
        stimulus = self.plan.stimulus(name)
        if stimulus is not None and stimulus.call is not None:
            self.blocked_by("service.offers", service=stimulus.call.service)

    def messages(self, topic: str) -> list[Message]:
        """Return the messages of a topic that count, in the window."""
        return self.in_window(self.sent(topic), lambda message: message.at)

    def sent(self, topic: str) -> list[Message]:
        """Return the messages of a topic that count: the judged node's, or the world's on its topics."""
        if is_of_world(self.plan.world, topic):
            return [one for one in self.seen.of_topic(topic) if one.sender in ("", OURS)]
        return [one for one in self.seen.of_topic(topic) if self._is_own(one.sender)]

    def _is_own(self, sender: str) -> bool:
        if not self._is_named:
            return True
        gone = self.run.exits or self.run.ended_by_itself  # (its ends left the graph with it)
        return sender in ("", self.node) or (gone and sender.startswith(UNKNOWN))

    @property
    def _is_named(self) -> bool:
        """Whether the judged node is known on the graph; its name is another check's matter."""
        return any(node.name == self.node for node in self.run.nodes)

    @property
    def _fellows(self) -> set[str]:
        """The full names of the nodes of the run's other programs."""
        names = names_of(
            self.evidence.assignment, self.plan, [node.name for node in self.whole_run.nodes]
        )
        mine = self.evidence.start
        return {name for n, own in enumerate(names) if n != mine for name in own} - {self.node}

    def foreign_senders(self, topic: str) -> list[str]:
        """Return who of the submission sent on a topic, and is not the judged node or another program's.

        One begins with UNKNOWN if no node on the graph has the publisher.
        """
        if is_of_world(self.plan.world, topic):
            return []
        found = {one.sender for one in self.seen.of_topic(topic) if not self._is_own(one.sender)}
        return sorted(found - self._fellows - {OURS})

    def foreign_owners(self, role: Role, *names: str, inside: str = "") -> list[str]:
        """Return who of the submission has such an end too, and is not the judged node or a fellow.

        The ends have one of the names, or a name that begins with `inside`.
        """
        if not self._is_named:
            return []
        found = {
            end.node
            for end in self.seen.ends
            if end.role == role and (end.name in names or (inside and end.name.startswith(inside)))
        }
        return sorted(found - self._fellows - {self.node})

    def ends(self, role: Role, *, of_actions: bool = False) -> list[End]:
        """Return the judged node's ends of a role, without those that rclpy makes by itself.

        One that the check asks for by its name is among them, and, `of_actions`, so are the
        services of actions.
        """
        asked = {getattr(self.given, key, "") for key in ("topic", "service")} - {*TOPICS}
        return [
            end
            for end in self.seen.ends
            if end.role == role
            and end.node == self.node
            and (end.name in asked or (of_actions and ACTION in end.name) or not is_of_ros(end))
        ]

    def call(self, *names: str, mentions: str = "") -> Where:
        """Return the line of the node's first call of one of these names, else the node's file.

        A call with the text `mentions` among its arguments comes before the others.
        """
        return call_in(self.evidence, *names, mentions=mentions)

    def field(self, path: str, *, topic: str) -> Where:
        """Return the line that sets a field of a message, as `linear.x`, else where it is published."""
        source = source_of_node(self.evidence)
        nodes = source.all_nodes if source is not None else []
        for each in (one for one in nodes if isinstance(one, ast.Assign)):
            sets = any(f".{dotted(target)}".endswith(f".{path}") for target in each.targets)
            if source is not None and sets:
                return Where(file=source.module_of(each).path, line=each.lineno)
        return self.call("publish", mentions=topic)
