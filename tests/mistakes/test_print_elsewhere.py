"""A print() in a function that has no self of the node: told where the node calls it."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.mistakes.recognise import behind_symptom
from grader.mistakes.recognised import Suspect
from tests.marking import ASSIGNMENT
from tests.mistakes.test_from_source import line_of, look, node_in
from tests.mistakes.test_named_exactly import LOG, changed, fix_of, patched

TEXT = "'Hello time: ' + str(self.counter_)"
CLASS = "class MyFirstNode"
LOGGED = f"self.get_logger().info({TEXT})"
START = "        self.counter_ = 0\n"


@pytest.mark.parametrize(
    ("helper", "call"),
    [
        ("class Serial:\n    @staticmethod\n    def println(text):\n        print(text, flush=True)\n", "Serial.println({})"),
        ("class Serial:\n    def println(text):\n        print(text)\n", "Serial.println({})"),
        ("class Serial:\n    def println(self, text):\n        print(text)\n", "Serial().println({})"),
        ("def print_line(text):\n    '''Print.'''\n    print(text)\n", "print_line({})"),
        ("def print_line(end, text):\n    print(text)\n", "print_line(1, {})"),
        ("say = lambda text: print(text)\n", "say({})"),
    ],
)  # fmt: skip
def test_the_call_of_a_function_that_only_prints(helper: str, call: str, tmp_path: Path) -> None:
    text = changed((CLASS, f"{helper}\n\n{CLASS}"), (LOG, call.format(TEXT)))
    found = look("run.print_not_logger", text)
    assert fix_of(found) == f"Write {LOGGED} instead of {call.format(TEXT)}."
    assert patched(found, text, tmp_path) == changed((CLASS, f"{helper}\n\n{CLASS}"))


def test_an_object_of_another_class(tmp_path: Path) -> None:
    helper = "class Serial:\n    def println(self, text):\n        print(text)\n\n\n"
    made = (START, f"{START}        self.serial = Serial()\n")
    text = changed((CLASS, helper + CLASS), made, (LOG, f"self.serial.println({TEXT})"))
    found = look("run.print_not_logger", text)
    assert patched(found, text, tmp_path) == changed((CLASS, helper + CLASS), made)


def test_a_function_that_makes_the_text_is_told_with_its_call() -> None:
    helper = "def show(n):\n    print('Hello time: ' + str(n))\n\n\n"
    text = changed((CLASS, helper + CLASS), (LOG, "show(self.counter_)"))
    found = look("run.print_not_logger", text)
    fix = "In show, self is not the node. Write self.get_logger().info(…) in line {}, where the node calls it, instead of show(self.counter_)."
    assert fix_of(found) == fix.format(line_of(text, "        show("))


@pytest.mark.parametrize(
    ("helper", "call", "written"),
    [
        (
            "def show(node):\n    print('Hello time: ' + str(node.counter_))\n\n\n",
            "show(self)",
            "node.get_logger().info('Hello time: ' + str(node.counter_))",
        ),
        (
            "class Out:\n    def __init__(self, node):\n        self.parent = node\n\n"
            "    def show(self, text):\n        print(text)\n\n\n",
            f"Out(self).show({TEXT})",
            "self.parent.get_logger().info(text)",
        ),
    ],
)
def test_a_function_that_has_the_node(helper: str, call: str, written: str) -> None:
    text = changed((CLASS, helper + CLASS), (LOG, call))
    found = look("run.print_not_logger", text)
    assert fix_of(found).startswith(f"Write {written} instead of print(")


def test_a_function_of_main_calls_the_node_by_its_variable() -> None:
    text = """\
import rclpy


def main():
    rclpy.init()
    node = rclpy.create_node('my_first_node')
    n = 0

    def tick():
        nonlocal n
        print('Hello time: ' + str(n))
        n += 1

    node.create_timer(1.0, tick)
    rclpy.spin(node)
"""
    found = behind_symptom("run.print_not_logger", Suspect(node_in(text), ASSIGNMENT))
    assert fix_of(found).startswith("Write node.get_logger().info('Hello time: ' + str(n)) instead")


def test_a_method_of_the_node_has_its_own_logger() -> None:
    text = changed((LOG, f"print({TEXT})"))
    assert fix_of(look("run.print_not_logger", text)).startswith(f"Write {LOGGED} instead")
