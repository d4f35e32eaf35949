#!/usr/bin/env python3
import time

import rclpy
from rclpy.node import Node


class Slow(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.counter = 0
        self.create_timer(1.0, self.callback)

    def callback(self):
        self.get_logger().info(f"Hello time: {self.counter}")
        self.counter += 1
        time.sleep(0.3)


def main(args=None):
    rclpy.init(args=args)
    node = Slow()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
