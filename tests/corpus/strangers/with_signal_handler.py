import signal
import sys

import rclpy
from rclpy.node import Node


class MyFirstNode(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.counter = 0
        self.create_timer(1.0, self.on_timer)

    def on_timer(self):
        self.get_logger().info(f"Hello time: {self.counter}")
        self.counter += 1


def stop(number, frame):
    rclpy.try_shutdown()
    sys.exit(0)


def main(args=None):
    rclpy.init(args=args)
    signal.signal(signal.SIGINT, stop)
    node = MyFirstNode()
    rclpy.spin(node)
