import time

import rclpy
from rclpy.clock import Clock, ClockType
from rclpy.node import Node


class Measuring(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.steady = Clock(clock_type=ClockType.STEADY_TIME)
        self.counter = 0
        self.slowest = 0.0
        self.create_timer(1.0, self.measured)

    def measured(self):
        begin = self.steady.now()
        self.work()
        self.slowest = max(self.slowest, (self.steady.now() - begin).nanoseconds / 1e9)

    def work(self):
        time.sleep(0.01)
        self.get_logger().info("Hello time: " + repr(self.counter))
        self.counter += 1
