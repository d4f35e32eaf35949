"""Errors of Python without a closer cause: what is None, and that nothing is claimed wrongly."""

from __future__ import annotations

import pytest

from grader.mistakes.recognise import behind_error
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.source.node import read_node
from grader.report.model import Where
from tests.marking import ASSIGNMENT

PATH = "my_robot_controller/my_first_node.py"
CODE = """\
import rclpy
from rclpy.node import Node


class MyFirstNode(Node):
    def __init__(self):
        super().__init__('my_first_node')
        self.counter_ = 0
        self.label = self.make_label()
        self.create_timer(1.0, self.timer_callback)

    def make_label(self):
        {body}

    def timer_callback(self):
        {line}
        self.counter_ += 1


def main(args=None):
    rclpy.init(args=args)
    rclpy.spin(MyFirstNode())
"""
LINE = 16
NO_ATTRIBUTE = "AttributeError: 'NoneType' object has no attribute 'upper'"
NO_SUM = "TypeError: unsupported operand type(s) for +: 'NoneType' and 'int'"


def found(error: str, line: str, body: str = "'Hello'") -> RecognisedMistake | None:
    text = CODE.format(line=line, body=body).encode()
    source = read_node({PATH: text}.get, PATH, "main")
    assert source is not None
    return behind_error(Raised(error, Where(file=PATH, line=LINE), source, ASSIGNMENT))


@pytest.mark.parametrize(
    ("error", "line", "code"),
    [
        (NO_ATTRIBUTE, "self.get_logger().info(self.make_label().upper())", "self.make_label()"),
        (NO_ATTRIBUTE, "self.get_logger().info(self.label.upper())", "self.label"),
        (NO_SUM, "self.get_logger().info(str(self.label + 1))", "self.label"),
    ],
)
def test_a_function_without_return_is_named(error: str, line: str, code: str) -> None:
    mistake = found(error, line)
    assert mistake is not None
    assert (mistake.kind, mistake.variant) == ("node.none_used", "function")
    assert (mistake.words["name"], mistake.words["function"]) == (code, "make_label")
    assert mistake.words["line"] == 12


@pytest.mark.parametrize("body", ["return 'Hello'", "yield 'Hello'"])
def test_a_function_that_gives_a_value_is_not_accused(body: str) -> None:
    mistake = found(NO_SUM, "self.get_logger().info(str(self.label + 1))", body)
    assert mistake is not None
    assert (mistake.kind, mistake.variant) == ("node.none_used", "line")


def test_a_none_from_elsewhere_is_not_a_misspelling() -> None:
    mistake = found(
        "AttributeError: 'NoneType' object has no attribute 'destroy_node'",
        "found.destroy_node()",
    )
    assert mistake is not None
    assert (mistake.kind, mistake.variant) == ("node.none_used", "")


@pytest.mark.parametrize(
    ("line", "imported"),
    [
        ("self.get_logger().info(str(count))", False),
        ("self.get_logger().info(str(count(1)))", False),
        ("self.get_logger().info(str(count.value))", False),
    ],
)
def test_a_variable_is_not_told_to_be_imported(line: str, imported: bool) -> None:
    mistake = found("NameError: name 'count' is not defined", line)
    assert mistake is not None
    assert (mistake.kind == "node.import_missing") == imported


@pytest.mark.parametrize(
    ("error", "kind", "variant"),
    [
        ("TypeError: 'method' object is not subscriptable", "types_do_not_fit", "function"),
        ("TypeError: 'int' object is not subscriptable", "types_do_not_fit", "one"),
        ("TypeError: 'int' object is not iterable", "types_do_not_fit", "one"),
        ("TypeError: cannot unpack non-iterable int object", "types_do_not_fit", "one"),
        ("TypeError: 'str' object does not support item assignment", "types_do_not_fit", "one"),
        (
            "TypeError: sequence item 1: expected str instance, int found",
            "types_do_not_fit",
            "one",
        ),
        ("TypeError: bad operand type for unary +: 'str'", "types_do_not_fit", "one"),
        (
            "TypeError: 'float' object cannot be interpreted as an integer",
            "types_do_not_fit",
            "one",
        ),
        (
            "ValueError: invalid literal for int() with base 10: 'one'",
            "types_do_not_fit",
            "number",
        ),
        (
            "TypeError: '<' not supported between instances of 'int' and 'str'",
            "types_do_not_fit",
            "",
        ),
        ("TypeError: __str__ returned non-string (type int)", "types_do_not_fit", "one"),
        ("TypeError: not enough arguments for format string", "text_and_values", ""),
        (
            "TypeError: %d format: a real number is required, not str",
            "text_and_values",
            "",
        ),
        ("IndexError: list index out of range", "no_such_item", ""),
        ("KeyError: 'count'", "no_such_item", "key"),
        ("TypeError: exceptions must derive from BaseException", "not_an_exception", ""),
    ],
)
def test_the_meaning_of_an_error_is_told(error: str, kind: str, variant: str) -> None:
    mistake = found(error, "self.work()")
    assert mistake is not None
    assert (mistake.kind, mistake.variant) == (f"node.{kind}", variant)


def test_a_class_that_is_imported_elsewhere_is_not_told_to_be_none() -> None:
    mistake = found("NameError: name 'Nodes' is not defined", "Nodes()")
    assert mistake is not None
    assert mistake.words.get("close") != "None"
    assert mistake.params.get("close") != "None"
