#!/usr/bin/env python3
"""A first node: it says hello once a second and counts how often."""

import rclpy
from rclpy.node import Node


class MyFirstNode(Node):
    """Logs `Hello time: 0`, `Hello time: 1` and so on, one line a second."""

    def __init__(self):
        super().__init__('my_first_node')
        self.counter_ = 0
        self.create_timer(1.0, self.timer_callback)

    def timer_callback(self):
        """Say hello once; the timer calls this for as long as the node spins."""
        self.get_logger().info('Hello time: ' + str(self.counter_))
        self.counter_ += 1


def main(args=None):
    """Run the node until Ctrl+C."""
    rclpy.init(args=args)
    node = MyFirstNode()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
