import threading

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node


class Counter:
    def __init__(self):
        self._lock = threading.Lock()
        self._value = -1

    def next(self):
        with self._lock:
            self._value += 1
            return self._value


class MyFirstNode(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.counter = Counter()
        group = ReentrantCallbackGroup()
        self.timer = self.create_timer(1.0, self.on_timer, callback_group=group)

    def on_timer(self):
        self.get_logger().info("Hello time: {}".format(self.counter.next()))


def main(args=None):
    rclpy.init(args=args)
    node = MyFirstNode()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        executor.shutdown()
        node.destroy_node()
