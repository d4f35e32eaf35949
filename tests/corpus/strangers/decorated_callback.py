import functools

import rclpy
from rclpy.node import Node


def guarded(method):
    @functools.wraps(method)
    def inner(self, *args):
        try:
            return method(self, *args)
        except ValueError as error:
            self.get_logger().error(str(error))

    return inner


class MyFirstNode(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.counter_ = 0
        self.create_timer(1.0, self.timer_callback)

    @guarded
    def timer_callback(self):
        self.get_logger().info(f"Hello time: {self.counter_}")
        self.counter_ += 1
