import rclpy
from rcl_interfaces.srv import ListParameters
from rclpy.node import Node


class MyFirstNode(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.counter = 0
        self.create_service(ListParameters, "numbers", self.numbers)
        self.create_timer(1.0, self.on_timer)

    def numbers(self, request, response):
        response.result.names = [str(n) for n in range(self.counter)]
        return response

    def on_timer(self):
        self.get_logger().info(f"Hello time: {self.counter}")
        self.counter += 1
