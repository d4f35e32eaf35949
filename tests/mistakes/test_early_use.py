"""An attribute that __init__ needs before it sets it: what is told, and at which line."""

from __future__ import annotations

import pytest

from grader.mistakes.recognise import behind_error
from grader.mistakes.recognised import Raised
from grader.package.source.node import read_node
from grader.report.model import Where
from tests.marking import ASSIGNMENT

FILE = "my_robot_controller/my_first_node.py"
CODE = """\
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Hello(Node):
    def __init__(self):
        super().__init__("my_first_node")
        {init}

    def tick(self):
        self.show()

    def show(self):
        self.get_logger().info(str(self.n))  # here


def main():
    rclpy.init()
    rclpy.spin(Hello())
"""


@pytest.mark.parametrize(
    ("init", "wanted", "at"),
    [
        (("self.create_timer(1.0, self.tick())", "self.n = 0"), "callback_called", 0),
        (("self.t = self.create_timer(1.0, self.show())", "self.n: int = 0"), "callback_called", 0),
        (
            ("self.create_subscription(String, 'a', self.show(), 10)", "self.n = 0"),
            "end_callback_called",
            0,
        ),
        (
            ("self.create_timer(1.0, self.tick)", "self.tick()", "self.n = 0"),
            "called_by_hand",
            1,
        ),
        (("x = 1", "self.show()", "self.n = 0"), "attribute_set_late", 1),
        # the attribute is set before, or nowhere, or only a callback that comes later needs it
        (("self.n = 0", "del self.n", "self.show()"), "attribute_not_set", None),
        (("self.show()", "self.m = 0"), "attribute_not_set", None),
        (("self.create_timer(1.0, self.tick)", "if False:\n            self.n = 0"),
         "attribute_not_set", None),
    ],
)  # fmt: skip
def test_an_attribute_that_is_not_set_yet(
    init: tuple[str, ...], wanted: str, at: int | None
) -> None:
    code = CODE.replace("{init}", "\n        ".join(init))
    here = next(n for n, line in enumerate(code.splitlines(), 1) if line.endswith("# here"))
    source = read_node({FILE: code.encode()}.get, FILE, "main")
    assert source is not None
    error = "AttributeError: 'Hello' object has no attribute 'n'"
    found = behind_error(Raised(error, Where(file=FILE, line=here), source, ASSIGNMENT))
    assert found is not None
    assert found.kind == f"node.{wanted}"
    assert found.where is not None
    assert found.where.line == (here if at is None else 9 + at)
