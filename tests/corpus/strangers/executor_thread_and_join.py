import threading

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


class Count(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.n = 0
        self.create_timer(1.0, self.on_timer)

    def on_timer(self):
        self.get_logger().info(f"Hello time: {self.n}")
        self.n += 1


def main():
    rclpy.init()
    node = Count()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    thread = threading.Thread(target=executor.spin)
    thread.start()
    try:
        thread.join()
    except KeyboardInterrupt:
        executor.shutdown()
        thread.join()
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
