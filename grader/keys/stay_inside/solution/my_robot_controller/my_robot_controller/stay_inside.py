#!/usr/bin/env python3
"""Keeps a turtle away from the wall: it listens to the pose and answers with a velocity."""

from geometry_msgs.msg import Twist
import rclpy
from rclpy.node import Node

try:
    from turtlesim.msg import Pose
except ImportError:
    from turtlesim_msgs.msg import Pose  # from ROS kilted on

NEAR = 2.0  # m from the wall
SIZE = 11.09  # m, the side of the field


class StayInside(Node):
    """Publishes a velocity for each pose: straight on, or a turn near the wall."""

    def __init__(self):
        super().__init__('stay_inside')
        self.turning_ = False
        self.publisher_ = self.create_publisher(Twist, '/turtle1/cmd_vel', 10)
        self.create_subscription(Pose, '/turtle1/pose', self.pose_callback, 10)

    def pose_callback(self, pose):
        """Decide what to do at a pose."""
        near = not (NEAR < pose.x < SIZE - NEAR and NEAR < pose.y < SIZE - NEAR)
        if near and not self.turning_:
            self.get_logger().info('Turning')
        self.turning_ = near
        message = Twist()
        if near:
            message.linear.x = 1.0
            message.angular.z = 1.5
        else:
            message.linear.x = 2.0
        self.publisher_.publish(message)


def main(args=None):
    """Run the node until Ctrl+C."""
    rclpy.init(args=args)
    node = StayInside()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
