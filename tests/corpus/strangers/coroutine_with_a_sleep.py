import asyncio
import threading

import rclpy
from rclpy.node import Node


class Async(Node):
    """The text comes from a coroutine of an event loop in a thread."""

    def __init__(self):
        super().__init__("my_first_node")
        self.loop = asyncio.new_event_loop()
        threading.Thread(target=self.loop.run_forever, daemon=True).start()
        self.count = 0
        self.create_timer(1.0, self.tick)

    async def text(self):
        await asyncio.sleep(0.01)
        return f"Hello time: {self.count}"

    def tick(self):
        future = asyncio.run_coroutine_threadsafe(self.text(), self.loop)
        self.get_logger().info(future.result(timeout=0.5))
        self.count += 1
