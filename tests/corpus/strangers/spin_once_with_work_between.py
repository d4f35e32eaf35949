import rclpy
from rclpy.node import Node


class MyFirstNode(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.counter = 0
        self.jobs = 0
        self.create_timer(1.0, self.on_timer)

    def on_timer(self):
        self.get_logger().info("Hello time: {0}".format(self.counter))
        self.counter += 1


def main(args=None):
    rclpy.init(args=args)
    node = MyFirstNode()
    try:
        while rclpy.ok():
            rclpy.spin_once(node, timeout_sec=0.02)
            node.jobs += 1
    except KeyboardInterrupt:
        pass
    node.destroy_node()
    rclpy.try_shutdown()
