"""Subscriptions that are read at our own rate, whatever the rate of the publishers.

rclpy's executor wakes up for every message: five turtles publish 600 a second, standing or not. The
node of these subscriptions is in no executor: the middleware keeps the newest messages, and `take`
reads them.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import Any

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

from lab.window.bridge.fields import message_type

KEPT = 200  # messages between two looks, of a topic of which each one counts
LOGS_KEPT = 1000  # as the publishers of /rosout (rcl's rosout profile)


class Stream:
    """The messages of one topic."""

    def __init__(self, node: Node, topic: str, kind: Any, profile: QoSProfile) -> None:
        self._node = node
        self._subscription = node.create_subscription(kind, topic, _unused, profile)
        self._most = profile.depth

    def take(self) -> Iterator[tuple[Any, float]]:
        """Yield the messages that have arrived, at most as many as are kept.

        Each comes with the time at which it was published, in s since the epoch.
        """
        for _ in range(self._most):
            with self._subscription.handle:
                taken = self._subscription.handle.take_message(self._subscription.msg_type, False)
            if taken is None:
                return
            stamp = taken[1].get("source_timestamp", 0)
            yield taken[0], (stamp or time.time_ns()) / 1e9

    def newest(self) -> Any:
        """Return the newest message that has arrived since the last call; None if none has."""
        message = None
        for message, _ in self.take():  # noqa: B007 - the last one
            pass
        return message

    def close(self) -> None:
        """End the subscription."""
        self._node.destroy_subscription(self._subscription)


def _unused(message: Any) -> None:
    del message


def stream(node: Node, entry: dict[str, Any], depth: int = KEPT) -> Stream | None:
    """Return the stream of a topic of the graph; None if it is not possible (now).

    Its type may not be installed, and Fast DDS refuses a second type for a topic that this program
    has a subscription of. It asks for no more than every publisher offers, so that it fits them all.
    """
    if not entry["publishers"]:
        return None
    kind = message_type(entry["publishers"][0]["type"])
    if kind is None:
        return None
    offered = [end["qos"] for end in entry["publishers"]]
    reliable = all(qos["reliability"] == "reliable" for qos in offered)
    latched = all(qos["durability"] == "transient_local" for qos in offered)
    profile = QoSProfile(
        depth=depth,
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )
    try:
        return Stream(node, entry["name"], kind, profile)
    except Exception:  # RCLError, which rclpy does not export on every distro
        return None


def newest_only(node: Node, topic: str, kind: Any) -> Stream:
    """Return a stream of which only the newest message matters."""
    profile = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
    return Stream(node, topic, kind, profile)


def logs(node: Node) -> Stream:
    """Return the stream of /rosout, older records included."""
    profile = QoSProfile(
        depth=LOGS_KEPT,
        reliability=ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy.TRANSIENT_LOCAL,
    )
    return Stream(node, "/rosout", message_type("rcl_interfaces/msg/Log"), profile)
