import os

import rclpy
from rclpy.node import Node


class MyFirstNode(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.robot = os.environ.get("ROBOT_NAME", "turtle")
        self.get_logger().debug(f"robot {self.robot}")
        self.counter = 0
        self.create_timer(float(os.getenv("HELLO_PERIOD", "1.0")), self.on_timer)

    def on_timer(self):
        self.get_logger().info(f"Hello time: {self.counter}")
        self.counter += 1
