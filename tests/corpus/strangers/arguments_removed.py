import argparse
import sys

import rclpy
from rclpy.node import Node
from rclpy.utilities import remove_ros_args


class MyFirstNode(Node):
    def __init__(self, first):
        super().__init__("my_first_node")
        self.counter = first
        self.create_timer(1.0, self.on_timer)

    def on_timer(self):
        self.get_logger().info(f"Hello time: {self.counter}")
        self.counter += 1


def main(args=None):
    parser = argparse.ArgumentParser()
    parser.add_argument("--first", type=int, default=0)
    options = parser.parse_args(remove_ros_args(sys.argv)[1:])
    rclpy.init(args=args)
    node = MyFirstNode(options.first)
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
