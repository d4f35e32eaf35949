import rclpy
from builtin_interfaces.msg import Time
from rclpy.node import Node


class Talker(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.outputs = [self.create_publisher(Time, f"wheel_{n}/stamp", 10) for n in range(8)]
        self.count = 0
        self.create_timer(0.05, self.publish)
        self.create_timer(1.0, self.hello)

    def publish(self):
        now = self.get_clock().now().to_msg()
        for output in self.outputs:
            output.publish(now)

    def hello(self):
        self.get_logger().info(f"Hello time: {self.count}")
        self.count += 1
