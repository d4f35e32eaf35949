import rclpy
from rclpy.logging import LoggingSeverity, get_logger, set_logger_level
from rclpy.node import Node


class MyFirstNode(Node):
    def __init__(self):
        super().__init__("my_first_node")
        set_logger_level("my_first_node", LoggingSeverity.INFO)
        self.log = get_logger("my_first_node")
        self.counter = 0
        self.create_timer(1.0, self.on_timer)

    def on_timer(self):
        self.log.debug("not shown")
        self.log.info(f"Hello time: {self.counter}")
        self.counter += 1
