import rclpy
from rclpy.node import Node


class Quarters(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.calls = 0
        self.create_timer(0.25, self.call)

    def call(self):
        self.calls += 1
        if self.calls % 4:
            return
        self.get_logger().info(f"Hello time: {self.calls // 4 - 1}")
