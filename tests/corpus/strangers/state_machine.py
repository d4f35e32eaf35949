import enum

import rclpy
from rclpy.node import Node


class State(enum.Enum):
    STARTING = "starting"
    COUNTING = "counting"


class Machine(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.state = State.STARTING
        self.number = 0
        self.handlers = {State.STARTING: self.start, State.COUNTING: self.count}
        self.create_timer(1.0, self.step)

    def step(self):
        self.handlers[self.state]()

    def start(self):
        self.state = State.COUNTING
        self.count()

    def count(self):
        self.get_logger().info(f"Hello time: {self.number}")
        self.number += 1
