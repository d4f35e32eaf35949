import rclpy
from rclpy.node import Node


class Counts:
    number = 0

    def take(self):
        taken, self.number = self.number, self.number + 1
        return taken


class Base(Node):
    NAME = ""
    PERIOD = 0.0

    def __init__(self):
        super().__init__(self.NAME)
        self.create_timer(self.PERIOD, self.on_timer)

    def on_timer(self):
        raise NotImplementedError


class MyFirstNode(Counts, Base):
    NAME = "my_first_node"
    PERIOD = 1.0

    def on_timer(self):
        self.get_logger().info(f"Hello time: {self.take()}")
