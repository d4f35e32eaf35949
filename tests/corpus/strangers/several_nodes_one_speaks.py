import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node


class Speaker(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.counter = 0
        self.create_timer(1.0, self.on_timer)

    def on_timer(self):
        self.get_logger().info(f"Hello time: {self.counter}")
        self.counter += 1


class Idle(Node):
    def __init__(self, number):
        super().__init__(f"idle_{number}")
        self.create_timer(0.1, lambda: None)


def main(args=None):
    rclpy.init(args=args)
    executor = SingleThreadedExecutor()
    nodes = [Idle(1), Speaker(), Idle(2), Idle(3)]
    for node in nodes:
        executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        for node in nodes:
            node.destroy_node()
        rclpy.try_shutdown()
