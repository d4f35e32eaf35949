"""A thread prepares the texts, the timer takes one a second."""

import queue
import threading

import rclpy
from rclpy.node import Node


class HelloTime(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.texts = queue.Queue(maxsize=4)
        self.done = threading.Event()
        self.writer = threading.Thread(target=self.write, daemon=True)
        self.writer.start()
        self.create_timer(1.0, self.tell)

    def write(self):
        number = 0
        while not self.done.is_set():
            try:
                self.texts.put(f"Hello time: {number}", timeout=0.2)
                number += 1
            except queue.Full:
                continue

    def tell(self):
        self.get_logger().info(self.texts.get())
