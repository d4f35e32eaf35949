import rclpy
from rclpy.node import Node


class Polite(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.get_logger().info("my first node has been started")
        self.get_logger().warn("press Ctrl+C to stop")
        self.times = 0
        self.timer_ = self.create_timer(1.0, self.greet)

    def greet(self):
        self.get_logger().info(f"Hello time: {self.times}")
        self.times += 1


def main(args=None):
    rclpy.init(args=args)
    node = Polite()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        print("Goodbye!")
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
