"""What one run of a scenario showed besides its log: messages, the graph, parameters, the world.

All instants are seconds of ROS time. A message counts at the instant of the step in which it was
read; the sender's stamp proves nothing.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Literal

Role = Literal["publisher", "subscription", "service", "client"]


@dataclass(frozen=True)
class Message:
    """A message: `values` are its fields."""

    topic: str
    at: float
    values: Any


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

    `accepted` has a reason for each parameter that was set, "" if it was accepted. `reply` is a
    service's answer, and `replied` when it came, None if none came.
    """

    name: str
    at: float
    heard: int = 0
    accepted: dict[str, str] = field(default_factory=dict)
    reply: Any = None
    replied: float | None = None


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
    """Where a turtle is at an instant (m, rad)."""

    turtle: str
    at: float
    x: float
    y: float
    theta: float


@dataclass
class Observations:
    """The observations of a run; `period` is the clock's, `instants` those that it showed.

    `counts` are the numbers of messages by topic; only the first of a step are in `messages`.
    `parameters` are by the node's full name. `stuck` is the instant from which on not every node
    answered, `silent` the full names of those of several that do not.
    `unusable` has the types of the submission's own packages that could not be used, and why.
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

    def of_topic(self, topic: str) -> list[Message]:
        """Return the messages of a topic, in order."""
        return [message for message in self.messages if message.topic == topic]

    def stimulus(self, name: str) -> Done | None:
        """Return what was done under a name; None if the run ended before."""
        return next((done for done in self.done if done.name == name), None)

    def goal(self, name: str) -> Goal | None:
        """Return what became of a goal; None if it was not sent."""
        return next((goal for goal in self.goals if goal.name == name), None)

    def ends_of(self, role: Role, name: str) -> list[End]:
        """Return the ends with a role and a name."""
        return [end for end in self.ends if end.role == role and end.name == name]
