import subprocess
import sys

import rclpy
from rclpy.node import Node


class MyFirstNode(Node):
    """Asks a helper process for each number."""

    CODE = "import sys\nfor n, _ in enumerate(sys.stdin): print(n, flush=True)"

    def __init__(self):
        super().__init__("my_first_node")
        self.helper = subprocess.Popen(
            [sys.executable, "-c", self.CODE],
            text=True,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
        )
        self.create_timer(1.0, self.on_timer)

    def on_timer(self):
        self.helper.stdin.write("next\n")
        self.helper.stdin.flush()
        self.get_logger().info("Hello time: " + self.helper.stdout.readline().strip())


def main(args=None):
    rclpy.init(args=args)
    node = MyFirstNode()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.helper.terminate()
        node.helper.wait()
        rclpy.try_shutdown()
