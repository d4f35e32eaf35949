import collections

import rclpy
from rclpy.node import Node


class MyFirstNode(Node):
    """Keeps the last ten texts; the number is how many there were."""

    def __init__(self):
        super().__init__("my_first_node")
        self.history = collections.deque(maxlen=10)
        self.total = 0
        self.create_timer(1.0, self.on_timer)

    def on_timer(self):
        text = "".join(("Hello time: ", format(self.total, "d")))
        self.history.append(text)
        self.total += 1
        self.get_logger().info(self.history[-1])
