"""draw_square: drives turtle1 along a square of 2 m, again and again."""

from __future__ import annotations

import math
from typing import Any

from geometry_msgs.msg import Twist
from std_srvs.srv import Empty

from .program import End, interfaces, start

SIDE = 2.0  # m
SPEED, TURN_SPEED = 1.0, 0.4  # m/s, rad/s
NEAR, NEARLY = 0.1, 0.01  # m and rad: how far from its goal the turtle may be
STILL = 0.0001  # m/s and rad/s


def within_pi(angle: float) -> float:
    """Return an angle (rad) in the range from -pi to pi."""
    return math.remainder(angle, 2 * math.pi)


class Square:
    """The corner that the turtle drives or turns to, from one pose to the next."""

    def __init__(self, node: Any) -> None:
        self._log = node.get_logger()
        self._publisher = node.create_publisher(Twist, "turtle1/cmd_vel", 1)
        self._step = "stop"
        self._goal = (0.0, 0.0, 0.0)
        self._next = "forward"
        node.create_subscription(interfaces("msg").Pose, "turtle1/pose", self.seen, 1)
        reset = node.create_client(Empty, "reset")
        if reset.wait_for_service(timeout_sec=1.0):
            reset.call_async(Empty.Request())

    def seen(self, pose: Any) -> None:
        """Give the turtle, which is at `pose`, its next command."""
        x, y, theta = self._goal
        if self._step == "stop":
            if max(abs(pose.linear_velocity), abs(pose.angular_velocity)) < STILL:
                self._begin(pose)
            self._drive(0.0, 0.0)
        elif self._step == "forward":
            if math.hypot(x - pose.x, y - pose.y) < NEAR:
                self._end("turn")
            self._drive(SPEED, 0.0)
        else:
            if abs(within_pi(theta - pose.theta)) < NEARLY:
                self._end("forward")
            self._drive(0.0, TURN_SPEED)

    def _begin(self, pose: Any) -> None:
        x, y, theta = pose.x, pose.y, pose.theta
        if self._next == "forward":
            x, y = x + math.cos(theta) * SIDE, y + math.sin(theta) * SIDE
        else:
            theta = within_pi(theta + math.pi / 2)
        self._goal, self._step = (x, y, theta), self._next
        self._log.info(f"New goal [{x:f} {y:f}, {theta:f}]")

    def _end(self, following: str) -> None:
        self._log.info("Reached goal")
        self._step, self._next = "stop", following

    def _drive(self, forward: float, turn: float) -> None:
        twist = Twist()
        if self._step != "stop":
            twist.linear.x, twist.angular.z = forward, turn
        self._publisher.publish(twist)


def main() -> int:
    """Draw until Ctrl+C."""

    def run(node: Any, end: End) -> None:
        square = Square(node)
        end.wait()
        del square

    return start("draw_square", run)
