import rclpy
from rclpy.node import Node


class MyFirstNode(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.counter = 0
        self.create_timer(0.1, self.watch)
        self.create_timer(1.0, self.on_timer)

    def watch(self):
        self.get_logger().debug("still here", throttle_duration_sec=2.0)
        self.get_logger().info("watching", once=True)

    def on_timer(self):
        self.get_logger().info(f"Hello time: {self.counter}")
        self.counter += 1
