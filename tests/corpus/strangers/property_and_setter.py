import rclpy
from rclpy.node import Node


class MyFirstNode(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self._counter = 0
        self.create_timer(1.0, self.timer_callback)

    @property
    def counter(self):
        return self._counter

    @counter.setter
    def counter(self, value):
        if value < self._counter:
            raise ValueError("it only counts up")
        self._counter = value

    def timer_callback(self):
        self.get_logger().info(f"Hello time: {self.counter}")
        self.counter += 1
