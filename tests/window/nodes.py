"""Nodes for the tests of the graph and the log, started one by one: python3 nodes.py WHICH.

It runs under the Python of a ROS prefix. `both` is four nodes at once; `late` comes later.
"""

from __future__ import annotations

import contextlib
import itertools
import math
import sys
import time

import rclpy
from geometry_msgs.msg import PointStamped
from rclpy.executors import SingleThreadedExecutor
from rclpy.logging import LoggingSeverity
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import Float64, Int32, String
from std_srvs.srv import Empty

BEST_EFFORT = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)


def talker(node: rclpy.node.Node) -> None:
    words = node.create_publisher(String, "words", 10)
    wave = node.create_publisher(Float64, "wave", 10)
    start = time.monotonic()

    def speak() -> None:
        words.publish(String(data="hello"))
        wave.publish(Float64(data=math.sin(2 * (time.monotonic() - start))))

    node.create_timer(0.02, speak)
    node.create_timer(0.5, lambda: node.get_logger().info("still here"))
    node.get_logger().warning("a warning of the talker")


def listener(node: rclpy.node.Node) -> None:
    node.create_subscription(String, "words", lambda message: None, 10)
    node.get_logger().error("an error of the listener")
    node.declare_parameter("rate", 2.5)
    node.declare_parameter("names", ["a", "b"])
    node.declare_parameter("loud", False)


def sensor(node: rclpy.node.Node) -> None:
    scan = node.create_publisher(Int32, "scan", BEST_EFFORT)
    node.create_timer(0.1, lambda: scan.publish(Int32(data=7)))


def stamper(node: rclpy.node.Node) -> None:
    """Says always the same, but when."""
    points = node.create_publisher(PointStamped, "a_point", 10)

    def say() -> None:
        message = PointStamped()
        message.header.stamp = node.get_clock().now().to_msg()
        message.point.x = 1.5
        points.publish(message)

    node.create_timer(0.05, say)


def reader(node: rclpy.node.Node) -> None:
    node.create_subscription(Int32, "scan", lambda message: None, 10)
    node.create_service(Empty, "reset_reader", lambda request, answer: answer)


def late(node: rclpy.node.Node) -> None:
    node.create_client(Empty, "reset_reader")
    node.create_subscription(Float64, "words", lambda message: None, 10)


def chatter(node: rclpy.node.Node) -> None:
    """Counts, as fast as the log of a test needs it."""
    numbers = itertools.count()
    node.get_logger().set_level(LoggingSeverity.DEBUG)

    def count() -> None:
        node.get_logger().info(f"line {next(numbers)}")
        node.get_logger().debug("nothing new")

    node.create_timer(0.01, count)


KINDS = {
    "chatter": chatter,
    "stamper": stamper,
    "talker": talker,
    "listener": listener,
    "sensor": sensor,
    "reader": reader,
    "late": late,
}


def main() -> None:
    rclpy.init(args=["--ros-args", "--disable-stdout-logs"])
    executor = SingleThreadedExecutor()
    nodes = []
    for name in sys.argv[1:]:
        node = rclpy.create_node(name)
        KINDS[name](node)
        executor.add_node(node)
        nodes.append(node)
    print("ready", flush=True)
    with contextlib.suppress(KeyboardInterrupt):
        executor.spin()


main()
