import rclpy
from rclpy.node import Node


class OnItsClock(Node):
    """Names the node's clock for the timer, and measures with it."""

    def __init__(self):
        super().__init__("my_first_node")
        self.begin = None
        self.count = 0
        self.timer = self.create_timer(1.0, self.tick, clock=self.get_clock())

    def tick(self):
        now = self.get_clock().now()
        if self.begin is None:
            self.begin = now
        elapsed = (now - self.begin).nanoseconds / 1e9
        self.get_logger().debug(f"{elapsed:.3f} s since the first")
        self.get_logger().info(f"Hello time: {self.count}")
        self.count += 1
