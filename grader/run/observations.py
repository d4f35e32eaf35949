"""What one run of a scenario showed besides its log: messages, the graph, parameters, the world.

All instants are seconds of ROS time. A message counts at the instant of the step in which it was
read; the sender's stamp proves nothing.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any, Literal

Role = Literal["publisher", "subscription", "service", "client"]
CREATES: Mapping[str, str] = MappingProxyType(
    {"publisher": "create_publisher", "subscription": "create_subscription"}
)
"""The method of a node that makes an end of a topic, by its role."""
OURS, UNKNOWN = "-", "?"  # in place of a sender (grader/run/in_probe/senders.py)


@dataclass(frozen=True)
class Message:
    """A message: `values` are its fields, `sender` the full name of the node that sent it.

    The sender is OURS for the probe and its world, "" if the middleware does not tell, and begins
    with UNKNOWN if the graph has no such node.
    """

    topic: str
    at: float
    values: Any
    sender: str = ""


@dataclass(frozen=True)
class End:
    """An end of a node on the graph; reliability and durability are of topics only.

    `differs` is whether its type has another definition than the one that the probe knows.
    """

    node: str
    role: Role
    name: str
    type: str
    reliability: str = ""
    durability: str = ""
    differs: bool = False


def refused(publisher: End, subscription: End) -> tuple[str, str] | None:
    """Return what a subscription asks for and a publisher does not offer, and what it offers; None if all fits."""
    for strong, asked, offered in (
        ("reliable", subscription.reliability, publisher.reliability),
        ("transient_local", subscription.durability, publisher.durability),
    ):
        if asked == strong and offered != strong:
            return asked, offered
    return None


@dataclass(frozen=True)
class Parameter:
    """A parameter of a node, as its services describe it when it was first seen: at the start."""

    name: str
    type: str
    value: Any
    read_only: bool = False
    range: tuple[float, float] | None = None


@dataclass
class Done:
    """What was done to the nodes at an instant: `heard` is how many ends received it.

    `accepted` has a reason for each parameter that was set, "" if it was accepted; `unproven` says
    for one that was accepted what does not show it: "event" (on /parameter_events) or "value". `reply`
    is a service's answer, and `replied` when it came, None if none came.
    """

    name: str
    at: float
    heard: int = 0
    accepted: dict[str, str] = field(default_factory=dict)
    reply: Any = None
    replied: float | None = None
    unproven: dict[str, str] = field(default_factory=dict)


@dataclass
class Goal:
    """What became of a goal; the instants are None for what did not happen.

    `status` is how it ended: succeeded, canceled or aborted. `refused` is when the node refused
    to take it, or to cancel it if it was accepted.
    """

    name: str
    at: float
    accepted: float | None = None
    refused: float | None = None
    feedback: list[tuple[float, Any]] = field(default_factory=list)
    status: str = ""
    result: Any = None
    ended: float | None = None


@dataclass(frozen=True)
class Pose:
    """Where a turtle is at an instant (m, rad); `put` is whether it was put there, not driven."""

    turtle: str
    at: float
    x: float
    y: float
    theta: float
    put: bool = False


@dataclass
class Observations:
    """The observations of a run; `period` is the clock's, `instants` those that it showed.

    `counts` are the numbers of messages by topic; only the first of a step are in `messages`.
    `parameters` are by the node's full name. `stuck` is the instant from which on not every node
    answered, `silent` the full names of those of several that do not.
    `unusable` has the types of the submission's own packages that could not be used, and why.
    `twins` are the full names that several nodes had at once.
    """

    period: float
    instants: list[float] = field(default_factory=list)
    messages: list[Message] = field(default_factory=list)
    counts: dict[str, int] = field(default_factory=dict)
    ends: list[End] = field(default_factory=list)
    parameters: dict[str, list[Parameter]] = field(default_factory=dict)
    done: list[Done] = field(default_factory=list)
    goals: list[Goal] = field(default_factory=list)
    path: list[Pose] = field(default_factory=list)
    events: list[dict[str, Any]] = field(default_factory=list)
    stuck: float | None = None
    unusable: dict[str, str] = field(default_factory=dict)
    silent: list[str] = field(default_factory=list)
    complete: bool = False
    twins: list[str] = field(default_factory=list)

    def of_topic(self, topic: str) -> list[Message]:
        """Return the messages of a topic, in order."""
        return [message for message in self.messages if message.topic == topic]

    def name_senders(self, names: Mapping[str, str]) -> None:
        """Give messages their senders that are known now, by what stood for them."""
        if names:
            self.messages = [
                replace(one, sender=names.get(one.sender, one.sender)) for one in self.messages
            ]

    def keep_graph(self, found: Mapping[str, Any]) -> None:
        """Add what the graph shows. Ends that were there once stay: some nodes destroy theirs."""
        known = {(end.node, end.role, end.name, end.type) for end in self.ends}
        for end in (End(**one) for one in found.get("ends", ())):
            if (end.node, end.role, end.name, end.type) not in known:
                self.ends.append(end)
        new = {str(name) for name in found.get("twins", ())} - {*self.twins}
        self.twins += sorted(new)

    def stimulus(self, name: str) -> Done | None:
        """Return what was done under a name; None if the run ended before."""
        return next((done for done in self.done if done.name == name), None)

    def goal(self, name: str) -> Goal | None:
        """Return what became of a goal; None if it was not sent."""
        return next((goal for goal in self.goals if goal.name == name), None)

    def ends_of(self, role: Role, name: str) -> list[End]:
        """Return the ends with a role and a name."""
        return [end for end in self.ends if end.role == role and end.name == name]


def parameter_from(found: Mapping[str, Any]) -> Parameter:
    """Return a parameter as the probe tells it."""
    bounds = found["range"]
    return Parameter(
        name=str(found["name"]),
        type=str(found["type"]),
        value=found["value"],
        read_only=bool(found["read_only"]),
        range=(float(bounds[0]), float(bounds[1])) if bounds else None,
    )
