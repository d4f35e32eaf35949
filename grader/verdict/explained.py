"""Which failed check of a node explains another one: what it lacks comes before what it then does.

A node that does not hear a topic cannot react to it, whatever its callback does. So a failure is told
once, by the check that is nearest to its cause; what follows from it is skipped because of that one.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from grader.course.worlds import is_of_world
from grader.mistakes.catalogue import CATALOGUE
from grader.verdict.checks.actual_node import of_entry
from grader.verdict.checks.declare import ANSWERS
from grader.verdict.checks.parsed import file_of, node_path

if TYPE_CHECKING:
    from grader.course.assignment import CheckUse
    from grader.course.scenario import RunPlan
    from grader.report.model import CheckResult
    from grader.verdict.checks.declare import Check
    from grader.verdict.of_node import NodeEvidence
    from grader.verdict.outcome import Failed

PERIODIC = ("topic.period", "log.period", "log.counts")
"""What a timer does, and not a message that the node receives."""
OF_MESSAGES = ("topic.values", "topic.reacts", "topic.period", "topic.silent")
UNLOGGED = "log.missing"
BEFORE_LOG = ("topic.", "service.", "action.", "parameter.")
ABSENT = (".no_publisher", ".no_subscription", ".missing", ".no_client", ".not_declared")
UNSENT = ("topic.never_published", "topic.too_few")


def explained_by(evidence: NodeEvidence, check: Check, use: CheckUse, failed: Failed) -> str:
    """Return the id of the failed check that explains a failure; "" if there is none."""
    kind = CATALOGUE.get(failed.mistake.id)
    if not check.is_of_run or kind is None:
        return ""
    mapping = evidence.id_of("entry_point.mapping")
    if evidence.has_failed(mapping) and _is_of_other_file(evidence):
        return mapping
    stays = evidence.id_of("run.stays")
    ended = evidence.run.ended_by_itself and evidence.has_failed(stays)
    if failed.mistake.id.endswith(ABSENT) and ended:
        return stays  # (what is made later, or goes first, was not seen)
    if kind.of_shape:
        return ""
    here = _Failure(evidence, check, use, failed.mistake.id)
    for other in evidence.assignment.checks:
        result = evidence.results.get(other.id)
        if other.id == use.id or result is None or result.status != "failed":
            continue
        is_own = result.node in ("", evidence.node)
        if here.follows_from(other, result) if is_own else here.is_fed_by(other, result):
            return other.id
    return ""


def _is_of_other_file(evidence: NodeEvidence) -> bool:
    """Whether the executable runs another file of the package, and the node's own is there."""
    other, own = of_entry(evidence), node_path(evidence)
    return other not in ("", own) and file_of(evidence, own) is not None


class _Failure:
    """A failed check of a run; `stimuli` are the names of what it comes after.

    `heard` are the topics to which its node subscribes, `is_periodic` is whether a timer is to do it.
    """

    def __init__(self, evidence: NodeEvidence, check: Check, use: CheckUse, mistake: str) -> None:
        self.check, self.use, self.mistake = check, use, mistake
        self.plan: RunPlan = evidence.assignment.plan(evidence.run_name)
        self.topic = str(use.with_.get("topic", ""))
        self.of_world = says_of_world(use, self.plan)
        own = {node.name for node in evidence.run.nodes}
        ends = evidence.run.seen.ends if evidence.run.seen is not None else []
        self.heard = {e.name for e in ends if e.node in own and e.role == "subscription"}
        alike = [one for one in evidence.assignment.checks if one.with_.get("topic") == self.topic]
        mine = {one.after for one in alike} if mistake in UNSENT else set()
        self.stimuli = {use.after} - {""} or mine - {""}
        kinds = {check.id, *(one.kind for one in alike if self.topic)}
        self.is_periodic = not kinds.isdisjoint(PERIODIC)

    def follows_from(self, other: CheckUse, result: CheckResult) -> bool:
        """Whether this failure follows from what another check found."""
        same_run = not other.run or self.plan.name == other.run
        if other.kind.startswith("interface."):
            return self._needs_type(other)
        if self.of_world:
            steers = not says_of_world(other, self.plan)
            return same_run and steers and other.kind.startswith(BEFORE_LOG)
        if self._lacks(other, result):
            return True
        if not same_run:
            return False
        if other.kind in ANSWERS and other.after in self.stimuli and self._is_later(other):
            return True
        return (
            self.mistake == UNLOGGED
            and not self.is_periodic
            and other.kind.startswith(BEFORE_LOG)
            and (other.after in ("", self.use.after) or not self.use.after)
        )

    def is_fed_by(self, other: CheckUse, result: CheckResult) -> bool:
        """Whether the check is about what another node sends to this one in the same run."""
        topic = other.with_.get("topic")
        judged = other.kind == "topic.publishes" or other.kind in OF_MESSAGES
        same_run = result.run == self.plan.name and not self._is_reached()
        return judged and same_run and topic != self.topic and topic in self.heard

    def _is_reached(self) -> bool:
        """Whether what the failure comes after reaches its node itself, not by way of another."""
        for one in filter(None, map(self.plan.stimulus, self.stimuli)):
            if one.publish is None or one.publish.topic in self.heard:
                return True
        return False

    def _is_later(self, other: CheckUse) -> bool:
        """Whether this is no answer itself, or one that comes after the other."""
        kind = self.check.id
        return kind not in ANSWERS or ANSWERS.index(other.kind) < ANSWERS.index(kind)

    def _needs_type(self, other: CheckUse) -> bool:
        """Whether it is about a type of an interface, or of a package of interfaces."""
        named = str(other.with_.get("type") or other.with_.get("package", ""))
        stimuli = [self.plan.stimulus(name) for name in self.stimuli]
        types = {str(self.use.with_.get("type", "")), self.plan.topics.get(self.topic, "")}
        types |= {what.type for one in stimuli if one is not None for what in one.typed.values()}
        return any(type_ == named or type_.startswith(f"{named}/") for type_ in types)

    def _lacks(self, other: CheckUse, result: CheckResult) -> bool:
        """Whether the other check found that the node does not get what it is to act on."""
        stimuli = [one for one in map(self.plan.stimulus, self.stimuli) if one is not None]
        given = other.with_
        if other.kind == "topic.subscribes":
            sent = {one.publish.topic for one in stimuli if one.publish is not None}
            return not self.is_periodic and sent <= {given["topic"]}
        if other.kind == "service.offers":
            return any(one.call and one.call.service == given["service"] for one in stimuli)
        if other.kind == "action.offers":
            return any(one.goal and one.goal.action == given["action"] for one in stimuli)
        if other.kind == "parameter.declared":
            name = str(given["name"])
            starts = [begin for begin in self.plan.start if begin.node in ("", result.node)]
            is_set = any(name in values for one in stimuli for values in (one.set or {}).values())
            return is_set or any(one.params_file or name in one.parameters for one in starts)
        return False


def says_of_world(use: CheckUse, plan: RunPlan) -> bool:
    """Whether a use of a check judges messages of a run's world: what came of the nodes' commands."""
    topic = str(use.with_.get("topic", ""))
    return use.kind in OF_MESSAGES and is_of_world(plan.world, topic)
