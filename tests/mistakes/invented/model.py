"""The form of an invented mistake, and the lines of the solution that are changed."""

from __future__ import annotations

from dataclasses import dataclass

from grader.package.edit.tree import Edit, Replace
from tests.corpus.model import NODE

STARTS, OUTPUT, SOURCE = "run.starts", "run.output", "source.node_file"
BUILD, ENTRY, STOP = "build.colcon", "entry_point.mapping", "run.interrupt"
LOG = "self.get_logger().info('Hello time: ' + str(self.counter_))"
TIMER = "self.create_timer(1.0, self.timer_callback)"
COUNT = "self.counter_ = 0"
STEP = "self.counter_ += 1"
SUPER = "super().__init__('my_first_node')"
CLASS = "class MyFirstNode(Node):"
MAKE = "node = MyFirstNode()"
SPIN = "rclpy.spin(node)"
IMPORT = "from rclpy.node import Node"
TARGET = "my_robot_controller.my_first_node:main"
SHEBANG = "#!/usr/bin/env python3"


@dataclass(frozen=True)
class Invented:
    """A package with one mistake: the check that must fail, its cause, and the place to name."""

    name: str
    edits: tuple[Edit, ...]
    fails: str
    cause: str
    place: str


def node(name: str, old: str, new: str, fails: str, cause: str, place: str) -> Invented:
    return Invented(name, (Replace(NODE, old, new),), fails, cause, place)


def within(path: str, name: str, old: str, new: str, fails: str, cause: str) -> Invented:
    return Invented(name, (Replace(path, old, new),), fails, cause, path)
