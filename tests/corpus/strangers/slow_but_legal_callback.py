import time

import rclpy
from rclpy.node import Node


class Slow(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.counter = 0
        self.create_timer(1.0, self.callback)

    def callback(self):
        self.get_logger().info(f"Hello time: {self.counter}")
        self.counter += 1
        time.sleep(0.3)
