import rclpy
from rclpy.node import Node


class Chatty(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.get_logger().debug("constructor begins")
        self.n = 0
        self.create_timer(1.0, self.callback)
        self.create_timer(0.02, self.busy)
        self.get_logger().debug("constructor ends")

    def busy(self):
        for level in range(20):
            self.get_logger().debug(f"value {level}")

    def callback(self):
        self.get_logger().debug("callback begins")
        self.get_logger().info(f"Hello time: {self.n}")
        self.n += 1
        self.get_logger().debug("callback ends")
