"""The topics that the probe hears without having said their names first.

A subscription shows its topic to every node on the graph. So a topic that only checks name which the
instructor keeps back is subscribed to once another node publishes on it. All other topics that the
submission's nodes publish on are subscribed to in the same way, whether anybody judges them or not:
the graph tells no node which of its topics are judged, and none that it does not have.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from typing import Any

from ament_index_python.resources import has_resource
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

from grader.run.in_probe.messages import interface

MOST_TOPICS = 60
MESSAGE = re.compile(r"([a-z][a-z0-9_]*)/msg/[A-Z]\w*", re.ASCII)
OF_ROS = ("/rosout", "/parameter_events", "/clock")
DEPTH = 2_000  # messages of a topic that wait to be taken


class Hearing:
    """The subscriptions of a scenario: `watched` are judged, `others` only look the same.

    `later` has the type of each topic that is kept back. Classes of the submission's own types
    (`of_students`) are only used if a check names them.
    """

    def __init__(self, node: Any, group: Any) -> None:
        self.node, self.group = node, group
        self.watched: dict[str, list[Any]] = {}
        self.others: dict[str, list[Any]] = {}
        self.later: dict[str, str] = {}
        self.kinds: dict[str, Any] = {}  # the classes of the types that the scenario names
        self.of_students: Collection[str] = ()  # packages
        self.worlds: set[str] = set()  # the names of our nodes that are part of a world
        self._publishers: dict[str, int] = {}

    def watch(self, topic: str, name: str) -> None:
        """Subscribe to a topic at once."""
        self.watched[topic] = [self.subscribe(topic, self.kinds[name], ReliabilityPolicy.RELIABLE)]

    def own(self, topic: str) -> int:
        """Return how many subscriptions to a topic are ours."""
        return len(self.watched.get(topic, ())) + len(self.others.get(topic, ()))

    def subscribe(self, topic: str, kind: Any, reliability: Any, depth: int = DEPTH) -> Any:
        """Return a subscription of which the executor takes nothing."""
        profile = QoSProfile(
            depth=depth, reliability=reliability, durability=DurabilityPolicy.VOLATILE
        )
        return self.node.create_subscription(
            kind, topic, lambda _: None, profile, callback_group=self.group
        )

    def look(self) -> None:
        """Subscribe to the topics that nodes publish on since the last look."""
        for topic, types in self.node.get_topic_names_and_types():
            count = self.node.count_publishers(topic)
            known = self._publishers.get(topic, 0)
            self._publishers[topic] = count
            if count == known or topic in OF_ROS:
                continue
            if topic in self.watched or topic in self.others:
                self._hear_best_effort(topic)
            else:
                self._hear(topic, types)

    def _hear(self, topic: str, types: Sequence[str]) -> None:
        infos = self.node.get_publishers_info_by_topic(topic)
        infos = [info for info in infos if info.node_name != self.node.get_name()]
        theirs = [info for info in infos if info.node_name not in self.worlds]
        wanted = self.later.get(topic, "")
        is_judged = wanted in {info.topic_type for info in infos}
        found = wanted if is_judged else theirs[0].topic_type if theirs else ""
        kind = self._class_of(found) if len(self.others) < MOST_TOPICS or is_judged else None
        if kind is None or found not in types:
            return
        offers = {info.qos_profile.reliability for info in infos if info.topic_type == found}
        only = offers == {ReliabilityPolicy.BEST_EFFORT}
        reliability = ReliabilityPolicy.BEST_EFFORT if only else ReliabilityPolicy.RELIABLE
        depth = DEPTH if is_judged else 1
        place = self.watched if is_judged else self.others
        place[topic] = [self.subscribe(topic, kind, reliability, depth)]

    def _class_of(self, name: str) -> Any:
        """Return the class of a type that a node names; None if it is not one of ROS or of a check."""
        match = MESSAGE.fullmatch(name)
        if name in self.kinds or match is None:
            return self.kinds.get(name)
        ours = match[1] not in self.of_students and has_resource("rosidl_interfaces", match[1])
        return interface(name) if ours else None

    def _hear_best_effort(self, topic: str) -> None:
        """Subscribe as best effort too if only such publishers are there."""
        subscriptions = self.watched.get(topic) or self.others[topic]
        best = ReliabilityPolicy.BEST_EFFORT
        if any(one.qos_profile.reliability == best for one in subscriptions):
            return
        infos = self.node.get_publishers_info_by_topic(topic)
        if {info.qos_profile.reliability for info in infos} == {best}:
            kind, depth = subscriptions[0].msg_type, subscriptions[0].qos_profile.depth
            subscriptions.append(self.subscribe(topic, kind, best, depth))
