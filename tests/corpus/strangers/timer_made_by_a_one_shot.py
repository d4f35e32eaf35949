import rclpy
from rclpy.node import Node


class Later(Node):
    """A first timer makes the second one and ends itself."""

    def __init__(self):
        super().__init__("my_first_node")
        self.counter = 0
        self.first = self.create_timer(0.1, self.begin)

    def begin(self):
        self.first.cancel()
        self.second = self.create_timer(1.0, self.hello)

    def hello(self):
        self.get_logger().info("Hello time: " + str(self.counter))
        self.counter += 1
