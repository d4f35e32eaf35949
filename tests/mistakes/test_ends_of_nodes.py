"""Errors at the ends of a node: what is told of the line that makes them, and of their callbacks."""

from __future__ import annotations

import pytest

from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.recognise import behind_error
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.source.node import read_node
from grader.report.model import Where
from tests.marking import ASSIGNMENT

NODE = "my_robot_controller/my_first_node.py"
TEXT = """\
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import SetBool


class MyFirstNode(Node):
    def __init__(self):
        super().__init__('my_first_node')
        self.declare_parameter('radius', 2.0)
        self.create_subscription(
            String, 'chatter', self.heard, 10)
        self.create_service(SetBool, 'drive', self.drive)

    def heard(self, message):
        radius = self.get_parameter('radius').value
        self.get_logger().info(message.data)
        self.speed = 2.0 / radius

    def drive(self, request, response):
        response.success = request.data
        return response


def main(args=None):
    rclpy.init(args=args)
    rclpy.spin(MyFirstNode())
"""


def told(error: str, at: str, old: str, new: str) -> tuple[RecognisedMistake, int]:
    """Return the mistake behind an error that the line with `at` raises, and the line that it is told of."""
    text = TEXT.replace(old, new)
    assert text != TEXT
    row = next(n for n, line in enumerate(text.splitlines(), 1) if at in line)
    source = read_node(lambda path: text.encode() if path == NODE else None, NODE, "main")
    assert source is not None
    found = behind_error(Raised(error, Where(file=NODE, line=row), source, ASSIGNMENT))
    assert found is not None
    assert found.where is not None
    return found, found.where.line or 0


def test_a_callback_that_is_called_where_it_is_passed_is_told_with_the_change() -> None:
    error = "TypeError: MyFirstNode.heard() missing 1 required positional argument: 'message'"
    found, line = told(error, "self.create_sub", "self.heard,", "self.heard(),")
    assert (found.kind, found.variant, line) == ("node.end_arguments", "called", 12)
    assert found.params == {"name": "self.heard()", "written": "self.heard"}


def test_a_method_that_makes_the_callback_may_be_called() -> None:
    error = "TypeError: MyFirstNode.heard() missing 1 required positional argument: 'message'"
    made = "return self.made\n\n    def made(self, message):\n        radius ="
    edited = TEXT.replace("radius =", made, 1).replace("self.heard,", "self.heard(),")
    source = read_node(lambda path: edited.encode() if path == NODE else None, NODE, "main")
    assert source is not None
    found = behind_error(Raised(error, Where(file=NODE, line=11), source, ASSIGNMENT))
    assert found is None or found.variant != "called"


def test_a_service_that_returns_nothing_is_told_at_its_last_line() -> None:
    found, line = told("TypeError", "rclpy.spin", "        return response\n", "")
    assert (found.kind, found.variant, line) == ("node.service_callback", "returned", 21)
    assert found.words["written"] == "response"
    assert "{written}" in str(CATALOGUE[found.kind].fixes["returned"])


def test_a_service_class_is_told_with_the_request_that_it_has() -> None:
    error = "NotImplementedError: Service classes can not be instantiated"
    found, line = told(
        error, "SetBool()", "self.speed =", "asked = SetBool()\n        self.speed ="
    )
    assert (found.kind, found.variant, line) == ("node.other_message", "service", 18)
    assert found.params == {"name": "SetBool()", "written": "SetBool.Request()"}


@pytest.mark.parametrize(
    "error",
    [
        "unsupported operand type(s) for /: 'float' and 'Parameter'",
        "'>' not supported between instances of 'float' and 'Parameter'",
        "'<' not supported between instances of 'Parameter' and 'float'",
    ],
)
def test_value_is_told_at_the_call_that_lacks_it(error: str) -> None:
    found, line = told(f"TypeError: {error}", "2.0 / radius", "('radius').value", "('radius')")
    assert (found.kind, line) == ("node.parameter_object", 16)
    assert found.params["written"] == "self.get_parameter('radius').value"
