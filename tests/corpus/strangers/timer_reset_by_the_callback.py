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
