#!/usr/bin/env python3
"""Starts and stops a turtle by a service, and lifts its pen while it stands."""

from geometry_msgs.msg import Twist
import rclpy
from rclpy.node import Node
from std_srvs.srv import SetBool

try:
    from turtlesim.srv import SetPen
except ImportError:
    from turtlesim_msgs.srv import SetPen  # from ROS kilted on


class StartStop(Node):
    """Drives while it is told to."""

    def __init__(self):
        super().__init__('start_stop')
        self.driving_ = False
        self.publisher_ = self.create_publisher(Twist, '/turtle1/cmd_vel', 10)
        self.create_service(SetBool, '/drive', self.drive_callback)
        self.pen_ = self.create_client(SetPen, '/turtle1/set_pen')
        self.create_timer(0.5, self.timer_callback)

    def drive_callback(self, request, response):
        """Start or stop, and say so."""
        self.driving_ = request.data
        pen = SetPen.Request()
        pen.r = 255
        pen.width = 3
        pen.off = 0 if request.data else 1
        self.pen_.call_async(pen)
        response.success = True
        response.message = 'driving' if request.data else 'standing'
        return response

    def timer_callback(self):
        """Publish a velocity twice a second while the turtle must drive."""
        if not self.driving_:
            return
        message = Twist()
        message.linear.x = 1.0
        message.angular.z = 0.5
        self.publisher_.publish(message)


def main(args=None):
    """Run the node until Ctrl+C."""
    rclpy.init(args=args)
    node = StartStop()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
