"""The turtles of turtlesim as the topics show them, and velocity commands for them."""

from __future__ import annotations

import math
import time
from typing import Any

from rclpy.node import Node

from lab.window.bridge.fields import message_type
from lab.window.bridge.parameters import Parameters
from lab.window.bridge.streams import Stream, newest_only

VELOCITY = "geometry_msgs/msg/Twist"  # (loaded for the first command: with it comes numpy, 12 MB)
TYPES = ("turtlesim/msg/Pose", "turtlesim_msgs/msg/Pose")
BACKGROUND = ("background_r", "background_g", "background_b")
MOST_TURTLES = 50
MATCH_SECONDS = 1.0  # in which a first command waits for the turtle's subscription
STILL_SECONDS = 0.5  # after which a turtle counts as standing


class Turtle:
    """A turtle and its newest pose: x and y in m, theta in rad, velocities in m/s and rad/s."""

    def __init__(self, node: Node, name: str, kind: Any) -> None:
        self.pose: list[float] | None = None
        self._stream: Stream = newest_only(node, f"{name}/pose", kind)

    def look(self) -> bool:
        """Take what has arrived; return whether the turtle has moved."""
        before, pose = self.pose, self._stream.newest()
        if pose is not None:
            values = [pose.x, pose.y, pose.theta, pose.linear_velocity, pose.angular_velocity]
            if all(map(math.isfinite, values)):
                self.pose = [round(value, 5) for value in values]
        return before != self.pose

    def close(self) -> None:
        """End the subscription."""
        self._stream.close()


class Turtles:
    """All turtles on the graph, and the publishers that drive them."""

    def __init__(self, silent: Node, parameters: Parameters) -> None:
        self._silent = silent
        self._parameters = parameters
        self._turtles: dict[str, Turtle] = {}
        self._publishers: dict[str, Any] = {}
        self._waiting: dict[str, tuple[float, Any]] = {}
        self._simulator = ""
        self._background: list[int] | None = None
        self._changed = True
        self._moved = 0.0

    def find(self, topics: list[dict[str, Any]]) -> None:
        """Begin with new turtles and end with those that are gone."""
        found: dict[str, tuple[str, str]] = {}
        for topic in topics:
            name, _, last = topic["name"].rpartition("/")
            kinds = {end["type"] for end in topic["publishers"]} & {*TYPES}
            if last == "pose" and name and kinds and len(found) < MOST_TURTLES:
                found[name] = (kinds.pop(), topic["publishers"][0]["node"])
        for name in set(self._turtles) - set(found):
            self._turtles.pop(name).close()
            self._changed = True
        for name, (kind, _) in found.items():
            message = message_type(kind)
            if name not in self._turtles and message is not None:
                self._turtles[name] = Turtle(self._silent, name, message)
        simulator = next((node for _, node in found.values()), "")
        if simulator != self._simulator:
            self._simulator, self._background = simulator, None
            self.ask_background()

    def ask_background(self, node: str | None = None) -> None:
        """Read the background's parameters; with `node`, only if it is the simulator."""
        if self._simulator and node in (None, self._simulator):
            self._parameters.values(self._simulator, list(BACKGROUND), self._on_background)

    def _on_background(self, values: Any) -> None:
        numbers = [value.integer_value for value in values or ()]
        if len(numbers) == len(BACKGROUND) and any(value.type for value in values):
            self._background = [min(max(number, 0), 255) for number in numbers]
            self._changed = True

    def look(self) -> dict[str, Any] | None:
        """Return the turtles if something has changed since the last call, else None."""
        moved = [turtle.look() for turtle in self._turtles.values()]
        if any(moved):
            self._moved = time.monotonic()
        changed, self._changed = any(moved) or self._changed, False
        return self.state() if changed else None

    def state(self) -> dict[str, Any]:
        """Return all turtles with their poses, and the background."""
        return {
            "background": self._background,
            "turtles": [
                [name, *turtle.pose]
                for name, turtle in sorted(self._turtles.items())
                if turtle.pose is not None
            ],
        }

    @property
    def moving(self) -> bool:
        """Whether a turtle has moved a moment ago, or a command waits."""
        return bool(self._waiting) or time.monotonic() - self._moved < STILL_SECONDS

    def drive(self, name: str, linear: float, angular: float) -> None:
        """Command a turtle's velocity (m/s and rad/s)."""
        if name not in self._turtles or not (math.isfinite(linear) and math.isfinite(angular)):
            return
        kind = message_type(VELOCITY)
        if kind is None:
            return
        if name not in self._publishers:
            self._publishers[name] = self._silent.create_publisher(kind, f"{name}/cmd_vel", 1)
        twist = kind()
        twist.linear.x, twist.angular.z = float(linear), float(angular)
        self._waiting[name] = (time.monotonic() + MATCH_SECONDS, twist)
        self.publish()

    def publish(self) -> None:
        """Publish the commands whose turtle listens by now."""
        for name, (until, twist) in list(self._waiting.items()):
            late = time.monotonic() > until
            if self._publishers[name].get_subscription_count() or late:
                self._publishers[name].publish(twist)
                del self._waiting[name]

    def close(self) -> None:
        """End all subscriptions; the publishers stay, in case the view comes back."""
        for turtle in self._turtles.values():
            turtle.close()
        self._turtles, self._simulator, self._changed = {}, "", True
