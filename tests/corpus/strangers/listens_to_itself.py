import rclpy
from builtin_interfaces.msg import Time
from rclpy.node import Node


class Echo(Node):
    """Publishes a number, and logs what comes back on the topic."""

    def __init__(self):
        super().__init__("my_first_node")
        self.number = 0
        self.publisher = self.create_publisher(Time, "number", 10)
        self.create_subscription(Time, "number", self.heard, 10)
        self.create_timer(1.0, self.say)

    def say(self):
        self.publisher.publish(Time(sec=self.number))
        self.number += 1

    def heard(self, message):
        self.get_logger().info("Hello time: " + str(message.sec))
