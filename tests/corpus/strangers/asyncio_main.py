import asyncio

import rclpy
from rclpy.node import Node


async def spin(node):
    while rclpy.ok():
        rclpy.spin_once(node, timeout_sec=0)
        await asyncio.sleep(0.005)


class Hello(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.count = 0
        self.create_timer(1.0, self.hello)

    def hello(self):
        self.get_logger().info(f"Hello time: {self.count}")
        self.count += 1


def main(args=None):
    rclpy.init(args=args)
    node = Hello()
    try:
        asyncio.run(spin(node))
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
