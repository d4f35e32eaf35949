#!/usr/bin/env python3
"""Drives a turtle in a circle: a node that publishes velocities."""

from geometry_msgs.msg import Twist
import rclpy
from rclpy.node import Node

SPEED = 2.0  # m/s


class DrawCircle(Node):
    """Publishes a velocity twice a second; the parameter `radius` (m) is the circle's."""

    def __init__(self):
        super().__init__('draw_circle')
        self.declare_parameter('radius', 2.0)
        self.publisher_ = self.create_publisher(Twist, '/turtle1/cmd_vel', 10)
        self.create_timer(0.5, self.timer_callback)

    def timer_callback(self):
        """Publish the velocity for the circle that is wanted now."""
        radius = self.get_parameter('radius').value
        message = Twist()
        message.linear.x = SPEED
        message.angular.z = SPEED / radius
        self.publisher_.publish(message)


def main(args=None):
    """Run the node until Ctrl+C."""
    rclpy.init(args=args)
    node = DrawCircle()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
