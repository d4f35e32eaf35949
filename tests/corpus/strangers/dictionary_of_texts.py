import rclpy
from rclpy.node import Node

TEXTS = {"en": "Hello time: {}", "ko": "안녕 시간: {}"}


class MyFirstNode(Node):
    def __init__(self, language="en"):
        super().__init__("my_first_node")
        self.text = TEXTS[language]
        self.numbers = iter(range(10**9))
        self.create_timer(1.0, self.on_timer)

    def on_timer(self):
        self.get_logger().info(self.text.format(next(self.numbers)))
