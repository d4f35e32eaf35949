import rclpy
from rclpy.node import Node


class MyFirstNode(Node):
    """The timer triggers a guard condition, whose callback speaks."""

    def __init__(self):
        super().__init__("my_first_node")
        self.counter = 0
        self.due = self.create_guard_condition(self.speak)
        self.create_timer(1.0, self.due.trigger)

    def speak(self):
        self.get_logger().info(f"Hello time: {self.counter}")
        self.counter += 1
