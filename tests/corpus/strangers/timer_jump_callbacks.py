import rclpy
from rclpy.clock import JumpThreshold
from rclpy.duration import Duration
from rclpy.node import Node


class MyFirstNode(Node):
    """Notices jumps of the clock and goes on counting."""

    def __init__(self):
        super().__init__("my_first_node")
        self.jumps = 0
        self.counter = 0
        threshold = JumpThreshold(
            min_forward=Duration(seconds=5), min_backward=None, on_clock_change=True
        )
        self.jump_handle = self.get_clock().create_jump_callback(threshold, post_callback=self.jumped)
        self.create_timer(1.0, self.on_timer)

    def jumped(self, jump):
        self.jumps += 1

    def on_timer(self):
        self.get_logger().info(f"Hello time: {self.counter}")
        self.counter += 1
