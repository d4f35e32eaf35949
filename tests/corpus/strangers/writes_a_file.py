import pathlib
import tempfile

import rclpy
from rclpy.node import Node


class MyFirstNode(Node):
    """Also keeps the lines in a file."""

    def __init__(self):
        super().__init__("my_first_node")
        folder = pathlib.Path(tempfile.mkdtemp())
        self.file = (folder / "lines.txt").open("w")
        self.counter = 0
        self.create_timer(1.0, self.on_timer)

    def on_timer(self):
        text = f"Hello time: {self.counter}"
        self.file.write(text + "\n")
        self.file.flush()
        self.get_logger().info(text)
        self.counter += 1

    def destroy_node(self):
        self.file.close()
        super().destroy_node()
