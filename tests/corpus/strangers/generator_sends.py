import rclpy
from rclpy.node import Node


def speaking(logger):
    number = 0
    while True:
        yield
        logger.info(f"Hello time: {number}")
        number += 1


class MyFirstNode(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.speech = speaking(self.get_logger())
        next(self.speech)
        self.create_timer(1.0, lambda: next(self.speech))
