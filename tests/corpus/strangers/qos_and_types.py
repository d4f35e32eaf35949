from __future__ import annotations

import rclpy
from builtin_interfaces.msg import Duration
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.timer import Timer

LATCHED = QoSProfile(
    depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL, reliability=ReliabilityPolicy.RELIABLE
)


class MyFirstNode(Node):
    publisher: Publisher
    timer: Timer

    def __init__(self) -> None:
        super().__init__("my_first_node")
        self.publisher = self.create_publisher(Duration, "~/uptime", LATCHED)
        self.seconds: int = 0
        self.timer = self.create_timer(1.0, self._tick)

    def _tick(self) -> None:
        self.get_logger().info(f"Hello time: {self.seconds}")
        self.seconds += 1
        self.publisher.publish(Duration(sec=self.seconds))
