import rclpy
from rclpy.node import Node


class Hello:
    def __init__(self, logger):
        self.logger = logger
        self.calls = 0

    def __call__(self):
        self.logger.info(f"Hello time: {self.calls}")
        self.calls += 1


class MyFirstNode(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.create_timer(1.0, Hello(self.get_logger()))
