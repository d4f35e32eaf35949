"""Programs of functions and helpers: what is told of them fits them."""

from __future__ import annotations

import pytest

from tests.mistakes.test_from_source import line_of, look, raised
from tests.mistakes.test_named_exactly import fix_of, why_of

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
NONE_SPUN = "AttributeError: 'NoneType' object has no attribute 'executor'"


def without(code: str, new: str = "", text: str = FUNCTIONS) -> str:
    assert text.count(code) == 1
    return text.replace(code, new)


def test_next_of_a_parameter_is_explained_by_the_order_of_the_values() -> None:
    wrong = without("beat.get_logger().info, count()", "count(), beat.get_logger().info")
    error = "TypeError: 'method' object is not an iterator"
    found = raised(error, wrong, line_of(wrong, "next("))
    assert found is not None
    assert found.kind == "node.not_an_iterator"
    assert "log, numbers" in fix_of(found)
    assert "write ()" not in fix_of(found)


def test_the_executor_gets_the_node_by_its_own_name() -> None:
    found = look("run.never_spins", without("    runner.add_node(beat)\n"))
    assert found is not None
    assert found.kind == "node.executor_without_node"
    assert "runner.add_node(beat)" in fix_of(found)
    assert "runner.spin()" not in fix_of(found)


@pytest.mark.parametrize(
    ("call", "variant", "written"),
    [
        ("step(log, count())", "partial_here", "partial(step, log, count())"),
        ("step(log, ticks)", "lambda", "lambda: step(log, ticks)"),
    ],
)
def test_a_callback_that_is_called_keeps_its_values(call: str, variant: str, written: str) -> None:
    wrong = without("partial(step, beat.get_logger().info, count())", call)
    error = "TypeError: 'NoneType' object is not callable"
    found = raised(error, wrong, line_of(wrong, "spin_once"))
    assert found is not None
    assert (found.kind, found.variant) == ("node.callback_called", variant)
    assert fix_of(found) == f"Write {written} instead of {call}."


def test_a_variable_of_another_function_is_not_given_to_spin() -> None:
    wrong = (
        "import rclpy\nfrom rclpy.node import Node\n\n\ndef make():\n    made = Node('a')\n"
        "    made.create_timer(1.0, print)\n\n\ndef main():\n    rclpy.init()\n"
        "    node = make()\n    rclpy.spin(node)\n"
    )
    found = raised(NONE_SPUN, wrong, line_of(wrong, "rclpy.spin("), inside="rclpy")
    assert found is not None
    assert (found.kind, found.variant) == ("node.spin_of_none", "returned")
    assert fix_of(found).startswith("Write return made as the last line of make")
    assert "make makes the node" in why_of(found)


def test_spin_of_a_variable_of_the_file_that_a_function_sets_for_itself() -> None:
    wrong = (
        "import rclpy\nfrom rclpy.node import Node\n\nnode = None\n\n\ndef setup():\n"
        "    rclpy.init()\n    node = Node('a')\n    node.create_timer(1.0, print)\n\n\n"
        "def main():\n    setup()\n    rclpy.spin(node)\n"
    )
    found = raised(NONE_SPUN, wrong, line_of(wrong, "rclpy.spin("), inside="rclpy")
    assert found is not None
    assert found.kind == "node.global_lost"
    assert fix_of(found) == "Write global node as the first line of setup."
