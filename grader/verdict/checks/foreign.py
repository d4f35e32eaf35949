"""Shared by the checks of one node's ends: another node of the submission that acts in its place."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from grader.base.i18n.message import Message, say
from grader.report.model import Where
from grader.run.names_of_ros import ACTION, LAST_PARTS
from grader.run.observations import UNKNOWN
from grader.verdict.outcome import Blocked, Failed

if TYPE_CHECKING:
    from grader.run.observations import Role
    from grader.verdict.checks.parameters import Parameters
    from grader.verdict.use import Use

FOREIGN = (
    *("topic.foreign_sender", "service.foreign_server", "service.foreign_client"),
    *("action.foreign_server", "parameter.foreign_server", "graph.node_twice"),
)


def must_be_alone(use: Use[Parameters], name: str) -> None:
    """Raise Failed if several nodes have the name: ROS does not tell which of them has an end.

    Blocked if another check says so.
    """
    seen = use.evidence.run.seen
    if seen is None or name not in seen.twins:
        return
    use.blocked_by("graph.node_name")
    for other in use.evidence.assignment.checks:
        if other.id != use.use.id and use.evidence.has_mistake(other.id, "graph.node_twice"):
            raise Blocked(by=other.id)
    raise Failed(
        "graph.node_twice",
        expected=say("one node of the name {name}", name=name),
        actual=say("several nodes on the ROS graph have the name {name}", name=name),
        where=use.call("__init__", "create_node", "Node"),
        params={"name": name},
    )


def must_send_itself(use: Use[Parameters], topic: str) -> None:
    """Raise Failed if another node of the submission sent messages on a topic.

    Blocked if another check says so, or that the node does not publish on it.
    """
    must_be_alone(use, use.node)
    found = use.foreign_senders(topic)
    if found:
        if use.use.kind != "topic.publishes":
            use.blocked_by("topic.publishes", topic=topic)
        _told_once(use, "topic.foreign_sender", "topic", topic)
        sender = found[0]
        raise Failed(
            "topic.foreign_sender",
            expected=say("messages on {topic} from {node}", topic=topic, node=use.node),
            actual=say("a message came from a publisher of no node on the ROS graph")
            if sender.startswith(UNKNOWN)
            else say("a message came from {other}", other=sender),
            where=use.call("create_publisher", "create_node", mentions=topic),
            params={"node": "" if sender.startswith(UNKNOWN) else sender},
            words={"topic": topic, "judged": use.node},
        )


def must_own_service(use: Use[Parameters], role: Role, service: str) -> None:
    """Raise Failed if another node of the submission offers a service too, or calls it (`role`)."""
    must_be_alone(use, use.node)
    offers = role == "service"
    found = use.foreign_owners(role, service)
    if found:
        if use.use.kind == "service.answers":
            use.blocked_by("service.offers", service=service)
        raise _owned(
            use,
            "service.foreign_server" if offers else "service.foreign_client",
            found,
            service,
            use.call("create_service" if offers else "create_client", mentions=service),
        )


def must_own_action(use: Use[Parameters], action: str) -> None:
    """Raise Failed if another node of the submission offers an action too."""
    must_be_alone(use, use.node)
    found = use.foreign_owners("service", inside=action + ACTION)
    found = found or use.foreign_owners("publisher", inside=action + ACTION)
    if found:
        if use.use.kind != "action.offers":
            use.blocked_by("action.offers", action=action)
        where = use.call("ActionServer", mentions=action)
        raise _owned(use, "action.foreign_server", found, action, where)


def must_own_parameters(use: Use[Parameters]) -> None:
    """Raise Failed if another node of the submission answers for the node's parameters."""
    must_be_alone(use, use.node)
    services = [f"{use.node}/{last}" for last in LAST_PARTS["service"]]
    found = use.foreign_owners("service", *services)
    if found:
        where = use.call("create_service", "create_node")
        raise _owned(use, "parameter.foreign_server", found, use.node, where)


def of_the_world_by_itself(use: Use[Parameters]) -> None:
    """Raise Blocked if a check found that another node acts in this run: the world shows what it did."""
    for other in use.evidence.assignment.checks:
        is_here = use.evidence.assignment.plan(other.run).name == use.plan.name
        if is_here and use.evidence.has_mistake(other.id, *FOREIGN):
            raise Blocked(by=other.id)


def _owned(
    use: Use[Parameters], mistake: str, found: Sequence[str], name: str, where: Where
) -> Failed:
    return Failed(
        mistake,
        expected=say("only {node} has it", node=use.node),
        actual=_listed(found),
        where=where,
        params={"node": found[0]},
        words={"service": name, "judged": use.node},
    )


def _listed(found: Sequence[str]) -> Message:
    return say("{other} has it too", other=", ".join(found))


def _told_once(use: Use[Parameters], mistake: str, key: str, value: str) -> None:
    for other in use.evidence.assignment.checks:
        same = other.id != use.use.id and other.with_.get(key) == value
        if same and use.evidence.has_mistake(other.id, mistake):
            raise Blocked(by=other.id)
