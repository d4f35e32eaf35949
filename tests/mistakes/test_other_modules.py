"""What a node takes from other modules of its package is followed and named there."""

from __future__ import annotations

from grader.mistakes.made_by import lines_that_make
from grader.package.source.node import NodeSource, read_node

NODE = """\
import rclpy
from rclpy.node import Node
from my_robot_controller.words import HELLO, count, text


class MyFirstNode(Node):
    def __init__(self):
        super().__init__('my_first_node')
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.get_logger().info(%s)


def main():
    rclpy.init()
    rclpy.spin(MyFirstNode())
"""
WORDS = """\
HELLO = 'Hello time: '
count = 0


def text(number):
    return HELLO.strip() + str(number)
"""
PATH = "my_robot_controller/my_first_node.py"


def node_that_logs(code: str) -> NodeSource:
    files = {PATH: NODE % code, "my_robot_controller/words.py": WORDS}
    texts = {path: text.encode() for path, text in files.items()}
    source = read_node(texts.get, PATH, "main")
    assert source is not None
    return source


def test_a_constant_of_another_module_is_named_with_its_file() -> None:
    made = str(lines_that_make(node_that_logs("HELLO + str(count)"), None))
    assert "my_robot_controller/words.py, line 1: HELLO = 'Hello time: '" in made
    assert "my_robot_controller/words.py, line 2: count = 0" in made


def test_a_method_that_changes_a_text_is_a_part_of_it() -> None:
    made = str(lines_that_make(node_that_logs("text(0)"), None, only_texts=True))
    assert "words.py, line 6: return HELLO.strip() + str(number)" in made


def test_a_place_in_another_module_is_read_there() -> None:
    source = node_that_logs("text(0)")
    assert source.module_at("my_robot_controller/words.py").line(1) == "HELLO = 'Hello time: '"
