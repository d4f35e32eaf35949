"""What in a package's source a person should look at."""

from __future__ import annotations

import pytest

from grader.package.intake.model import SourceFile
from grader.package.source.remarks import MOST_REMARKS, Remark, remarks_on

NODE = """\
import os
import sys
import rclpy
from rclpy.node import Node

class MyNode(Node):
    def __init__(self):
        super().__init__('my_node')
        self.create_timer(1.0, self.tick)

    def tick(self):
        pass

def main(args=None):
    rclpy.init(args=args)
    node = MyNode()
    rclpy.spin(node)
    node.destroy_node()
    rclpy.shutdown()

if __name__ == '__main__':
    main()
"""


def file(text: str, path: str = "my_package/my_node.py") -> SourceFile:
    return SourceFile(path, "file", 0o755, text.encode())


def kinds(text: str, path: str = "my_package/my_node.py") -> set[tuple[str, str]]:
    return {(remark.kind, remark.what) for remark in remarks_on([file(text, path)])}


def test_a_usual_node_has_no_remark() -> None:
    assert remarks_on([file(NODE)]) == []


@pytest.mark.parametrize(
    ("code", "remark"),
    [
        ("x = getattr(os, 'envi' + 'ron')", ("hides", "getattr")),
        ("os._exit(0)", ("ends", "os._exit")),
        ("rclpy.shutdown()", ("ends", "rclpy.shutdown")),
        ("raise SystemExit", ("ends", "raise")),
        ("self.timer.cancel()", ("ends", "self.timer.cancel")),
        ("exec('x = 1')", ("hides", "exec")),
        ("x = __import__('os')", ("hides", "__import__")),
        ("self.create_publisher(Log, '/rosout', 10)", ("rosout", "/rosout")),
    ],
)
def test_what_ends_or_hides_is_found_with_its_line(code: str, remark: tuple[str, str]) -> None:
    text = NODE.replace("        pass\n", f"        {code}\n")
    (found,) = remarks_on([file(text)])
    assert (found.kind, found.what) == remark
    assert found.line == text.splitlines().index(f"        {code}") + 1


def test_an_attribute_that_is_named_in_the_source_hides_nothing() -> None:
    assert kinds(NODE.replace("        pass\n", "        getattr(self, 'n', 0)\n")) == set()


def test_setup_tests_and_launch_files_are_not_the_node() -> None:
    text = "exec('x = 1')\n"
    for path in ("setup.py", "test/test_node.py", "launch/start.launch.py"):
        assert kinds(text, path) == set()
    assert kinds(text) == {("hides", "exec")}


def test_what_cannot_be_read_is_a_remark() -> None:
    assert remarks_on([file("x = 1\n", "my_package/fast.so")]) == [
        Remark("hides", "my_package/fast.so", None, "so")
    ]
    assert kinds("x = 1\n" * 20_000) == {("hides", "120000 bytes")}
    assert kinds("def (:\n") == set()  # the node cannot be read by Python either


def test_few_of_one_kind_are_enough() -> None:
    found = remarks_on([file(NODE + "exec('x')\n" * 100)])
    assert len(found) == MOST_REMARKS
