"""mimic: lets one turtle do what another one does (remap input/pose and output/cmd_vel)."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import Twist

from .program import End, interfaces, start


def main() -> int:
    """Pass the velocities on until Ctrl+C."""

    def run(node: Any, end: End) -> None:
        publisher = node.create_publisher(Twist, "output/cmd_vel", 1)

        def seen(pose: Any) -> None:
            twist = Twist()
            twist.linear.x, twist.angular.z = pose.linear_velocity, pose.angular_velocity
            publisher.publish(twist)

        node.create_subscription(interfaces("msg").Pose, "input/pose", seen, 1)
        end.wait()

    return start("turtle_mimic", run)
