#!/usr/bin/env python3
import rclpy
from rclpy.node import Node


class Resets(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.counter = 0
        self.timer = self.create_timer(1.0, self.hello)

    def hello(self):
        self.timer.reset()
        self.get_logger().info("Hello time: " + str(self.counter))
        self.counter += 1


def main(args=None):
    rclpy.init(args=args)
    node = Resets()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
