import rclpy
from rclpy.node import Node


class SecondsSince(Node):
    """The number is the seconds since the first call, by the node's clock."""

    def __init__(self):
        super().__init__("my_first_node")
        self.first = None
        self.create_timer(1.0, self.tick)

    def tick(self):
        now = self.get_clock().now().nanoseconds
        if self.first is None:
            self.first = now
        self.get_logger().info("Hello time: %d" % round((now - self.first) / 1e9))
