"""A stand-in for turtlesim on the wall clock: its topics and its parameters, and nothing more.

    python3 turtles.py COUNT [MOVE]

It runs under the Python of a ROS prefix. With MOVE the turtles go in circles by themselves.
"""

from __future__ import annotations

import contextlib
import math
import sys
import time
from typing import Any

import rclpy
from geometry_msgs.msg import Twist
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from turtlesim.msg import Pose

DT = 0.016
SIZE = 499 / 45


class StandIn:
    """One turtle."""

    def __init__(self, node: Node, number: int, move: bool) -> None:
        name = f"/turtle{number}"
        self.x = self.y = SIZE / 2
        self.theta = 2 * math.pi * number / 5 if number > 1 else 0.0
        self.twist = (1.0 + 0.2 * number, 0.8) if move else (0.0, 0.0)
        self.until = math.inf if move else 0.0
        self.pose = node.create_publisher(Pose, f"{name}/pose", 10)
        node.create_subscription(Twist, f"{name}/cmd_vel", self.command, 7)

    def command(self, twist: Any) -> None:
        self.twist = (twist.linear.x, twist.angular.z)
        self.until = time.monotonic() + 1.0

    def step(self) -> None:
        linear, angular = self.twist if time.monotonic() < self.until else (0.0, 0.0)
        self.theta = math.remainder(self.theta + angular * DT, 2 * math.pi)
        self.x = min(max(self.x + math.cos(self.theta) * linear * DT, 0.0), SIZE)
        self.y = min(max(self.y + math.sin(self.theta) * linear * DT, 0.0), SIZE)
        self.pose.publish(
            Pose(
                x=self.x,
                y=self.y,
                theta=self.theta,
                linear_velocity=float(linear),
                angular_velocity=float(angular),
            )
        )


def main() -> None:
    rclpy.init()
    node = rclpy.create_node("turtlesim")
    for letter, value in (("r", 69), ("g", 86), ("b", 255)):
        node.declare_parameter(f"background_{letter}", value)
    turtles = [
        StandIn(node, number, len(sys.argv) > 2) for number in range(1, int(sys.argv[1]) + 1)
    ]

    def step() -> None:
        for turtle in turtles:
            turtle.step()

    node.create_timer(DT, step)
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    with contextlib.suppress(KeyboardInterrupt):
        executor.spin()


main()
