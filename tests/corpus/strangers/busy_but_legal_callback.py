import rclpy
from rclpy.node import Node


def primes(below):
    found = []
    for n in range(2, below):
        if all(n % p for p in found if p * p <= n):
            found.append(n)
    return found


class Computes(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.counter = 0
        self.create_timer(1.0, self.callback)

    def callback(self):
        primes(8_000)
        self.get_logger().info(f"Hello time: {self.counter}")
        self.counter += 1
