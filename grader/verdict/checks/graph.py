"""Kinds of check for the ROS graph: which nodes there are, their names and connections."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from pydantic import Field

from grader.base.i18n.message import say
from grader.base.nearest import nearest, with_difference
from grader.verdict.checks.declare import kind
from grader.verdict.checks.foreign import must_be_alone
from grader.verdict.checks.parameters import Parameters
from grader.verdict.node_files import source_of_node
from grader.verdict.outcome import Failed, Inconclusive, Passed

if TYPE_CHECKING:
    from grader.run.observations import End
    from grader.verdict.use import Use


class NodeName(Parameters):
    """The name of the node, with its namespace if that is not /; "" for each node's own name."""

    name: str = ""


class Nodes(Parameters):
    """The full names of nodes, such as /talker; `others` is whether there may be more."""

    names: tuple[str, ...] = Field(min_length=1)
    others: bool = True


class Connection(Parameters):
    """A topic by which one node sends to another: `sender` and `receiver` are full names."""

    topic: str
    sender: str
    receiver: str


@kind("graph.node_name", NodeName, depends=["run.starts"], after=["run.spins"], covers="runs")
def node_name(use: Use[NodeName]) -> Passed:
    """The node has the required name."""
    run, wanted = (
        use.evidence.run,
        f"/{use.given.name.lstrip('/')}" if use.given.name else use.wanted,
    )
    names = [run.counting] if run.counting else [node.name for node in run.nodes]
    if wanted in names:
        must_be_alone(use, wanted)
        return Passed(actual=wanted)
    if not names:
        raise Inconclusive(say("the ROS graph could not be read"))
    listed = ", ".join(names)
    right = "named"
    if any(node.name == wanted for node in run.nodes):
        right = "other"
        listed = say("the lines come from {name}", name=run.counting)
    if use.given.name and wanted != f"/{use.evidence.assignment.node_name}":
        raise _missing(wanted, wanted, listed, use)
    close = nearest(wanted, names) or names[0]
    raise Failed(
        "run.wrong_node_name",
        expected=wanted,
        actual=with_difference(listed, close, wanted),
        where=use.call(),
        variant=right if _is_passed(use, wanted) else "",
        params={"name": names[0].lstrip("/")},
        words={"wanted": wanted.lstrip("/")},
    )


def _is_passed(use: Use[NodeName], wanted: str) -> bool:
    """Whether the source passes the required name to super().__init__()."""
    source = source_of_node(use.evidence)
    call = source.super_init if source is not None else None
    given = call.args[0] if call is not None and call.args else None
    return isinstance(given, ast.Constant) and given.value == wanted.lstrip("/")


def _missing(name: str, expected: str, actual: str, use: Use[Parameters]) -> Failed:
    """Return the failure of a run without the node of a name."""
    return Failed(
        "graph.node_missing",
        expected=expected,
        actual=actual,
        where=use.call("__init__", "create_node", "Node"),
        params={"name": name},
    )


@kind("graph.nodes", Nodes, after=["graph.node_name"])
def nodes(use: Use[Nodes]) -> Passed:
    """The ROS graph has the nodes {names}"""
    given = use.given
    found = {node.name for node in use.whole_run.nodes}
    missing = [name for name in given.names if name not in found]
    more = sorted(found - set(given.names))
    listed = ", ".join(sorted(found)) or "-"
    if missing:
        raise _missing(missing[0], ", ".join(given.names), listed, use)
    if more and not given.others:
        raise Failed(
            "graph.node_unexpected",
            expected=say("only {names}", names=", ".join(given.names)),
            actual=listed,
            where=use.call("__init__", "create_node", "Node"),
            params={"name": more[0]},
        )
    return Passed(actual=listed)


@kind("graph.connects", Connection, after=["topic.publishes", "topic.subscribes"])
def connects(use: Use[Connection]) -> Passed:
    """{sender} sends to {receiver} on {topic}"""
    given = use.given
    for name in (given.sender, given.receiver):
        must_be_alone(use, name)
    publishers = {end.type for end in _of(use, given.sender, "publisher")}
    subscriptions = {end.type for end in _of(use, given.receiver, "subscription")}
    expected = say("{sender} sends to {receiver} on {topic}", **given.model_dump())
    if publishers & subscriptions:
        return Passed()
    lacking = given.receiver if publishers else given.sender
    actual = say("{node} has no such end on the ROS graph", node=lacking)
    variant = ""
    if publishers and subscriptions:
        kinds = {"mine": min(publishers), "theirs": min(subscriptions)}
        variant = "type"
        actual = say("one sends {mine}, the other expects {theirs}", **kinds)
    raise Failed(
        "graph.not_connected",
        expected=expected,
        actual=actual,
        where=use.call("create_publisher", "create_subscription", mentions=given.topic),
        params={"node": lacking},
        words={"topic": given.topic},
        variant=variant,
    )


def _of(use: Use[Connection], node: str, role: str) -> list[End]:
    ends = use.seen.ends
    return [end for end in ends if (end.node, end.role, end.name) == (node, role, use.given.topic)]
