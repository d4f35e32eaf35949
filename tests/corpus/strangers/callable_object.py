#!/usr/bin/env python3
import rclpy
from rclpy.node import Node


class Hello:
    def __init__(self, logger):
        self.logger = logger
        self.calls = 0

    def __call__(self):
        self.logger.info(f"Hello time: {self.calls}")
        self.calls += 1


class MyFirstNode(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.create_timer(1.0, Hello(self.get_logger()))


def main(args=None):
    rclpy.init(args=args)
    node = MyFirstNode()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
