"""What the texts call the node: self in a class of its own, else the variable that has it."""

from __future__ import annotations

import pickle
from dataclasses import dataclass

import pytest

from grader.base.i18n.message import Message, joined, reworded
from grader.package.source.node import NodeSource, read_node
from grader.package.source.node_here import node_here
from grader.verdict.node_words import words_for

PATH = "a/node.py"
FUNCTION = """\
import rclpy


def main(args=None):
    rclpy.init(args=args)
    n = rclpy.create_node('a')

    def hello():
        n.get_logger().info('a')

    n.create_timer(1.0, hello)
    rclpy.spin(n)
"""
HELD = """\
import rclpy


class Greeter:
    def __init__(self):
        self.node = rclpy.create_node('a')

    def hello(self):
        pass


def main(args=None):
    greeter = Greeter()
"""
PASSED = """\
from rclpy.node import Node


class Greeter:
    def __init__(self, node):
        self.owner = node


def main(args=None):
    n = Node('a')
    greeter = Greeter(n)
"""
CLASS = """\
from rclpy.node import Node


class Greeter(Node):
    def __init__(self):
        super().__init__('a')

    def hello(self):
        pass


def main(args=None):
    n = Greeter()
"""
TEXT = "Write self.create_timer({period}, self.{callback}) in __init__"


def source_of(code: str) -> NodeSource:
    found = read_node(lambda path: code.encode() if path == PATH else None, PATH, "main")
    assert found is not None
    return found


def told(code: str, template: str) -> str:
    values: dict[str, str | int | float]
    values = {"period": 1.0, "callback": "hello", "node_name": "a", "function": "hello"}
    return reworded(Message(template, values), words_for(source_of(code)))


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        (CLASS, "Write self.create_timer(1.0, self.hello) in __init__"),
        (FUNCTION, "Write n.create_timer(1.0, hello) in main"),
        (HELD, "Write self.node.create_timer(1.0, self.hello) in __init__"),
        (PASSED, "Write self.owner.create_timer(1.0, self.hello) in __init__"),
    ],
)
def test_a_text_calls_the_node_as_the_program_does(code: str, expected: str) -> None:
    assert told(code, TEXT) == expected


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        (CLASS, "super().__init__('a')"),
        (FUNCTION, "rclpy.create_node('a')"),
        (PASSED, "Node('a')"),
    ],
)
def test_a_text_names_the_call_that_creates_the_node(code: str, expected: str) -> None:
    assert told(code, "super().__init__('{node_name}')") == expected


@dataclass
class Korean:
    """A catalogue with one text."""

    def gettext(self, template: str, /) -> str:
        assert template == "in {name}: self.create_timer"
        return "{name}에: self.create_timer"

    def ngettext(self, one: str, many: str, count: int, /) -> str:
        raise AssertionError


def test_other_words_are_written_in_every_language_and_values_stay() -> None:
    text = Message("in {name}: self.create_timer", {"name": "self.create_timer"})
    found = reworded(joined(text, by=" "), words_for(source_of(FUNCTION)))
    assert found == "in self.create_timer: n.create_timer"
    assert isinstance(found, Message)
    again = pickle.loads(pickle.dumps(found))
    assert again == found
    assert again.translated(Korean()) == "self.create_timer에: n.create_timer"


@pytest.mark.parametrize(
    ("code", "line", "expected"),
    [
        (CLASS, 9, "self"),
        (CLASS, 13, "n"),
        (FUNCTION, 9, "n"),
        (HELD, 9, "self.node"),
        (HELD, 13, ""),
    ],
)
def test_a_line_reaches_the_node_by_a_name(code: str, line: int, expected: str) -> None:
    source = source_of(code)
    assert node_here(source, source.module, line) == expected
