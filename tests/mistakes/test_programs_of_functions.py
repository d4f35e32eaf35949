"""Programs of functions and helpers: what is told of them fits them."""

from __future__ import annotations

from tests.mistakes.test_from_source import look
from tests.mistakes.test_named_exactly import fix_of

FUNCTIONS = """\
from functools import partial
from itertools import count

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


def step(log, numbers):
    log(f'Hello time: {next(numbers)}')


def main(args=None):
    rclpy.init(args=args)
    beat = Node('my_first_node')
    beat.create_timer(1.0, partial(step, beat.get_logger().info, count()))
    runner = SingleThreadedExecutor()
    runner.add_node(beat)
    while rclpy.ok():
        runner.spin_once(timeout_sec=0.5)
"""


def without(code: str, new: str = "", text: str = FUNCTIONS) -> str:
    assert text.count(code) == 1
    return text.replace(code, new)


def test_the_executor_gets_the_node_by_its_own_name() -> None:
    found = look("run.never_spins", without("    runner.add_node(beat)\n"))
    assert found is not None
    assert found.kind == "node.executor_without_node"
    assert "runner.add_node(beat)" in fix_of(found)
    assert "runner.spin()" not in fix_of(found)
