import rclpy
from rclpy.node import Node


class Parts(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.motor_log = self.get_logger().get_child("motor")
        self.motor_log.info("motor ready")
        self.i = 0
        self.timer = self.create_timer(1, self.timer_cb)

    def timer_cb(self):
        self.get_logger().info("Hello time: " + str(self.i))
        self.i += 1
        self.motor_log.debug("turned")
