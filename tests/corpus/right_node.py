"""The node with its text, its class or its ending written differently."""

from __future__ import annotations

from grader.mistakes.example import SPIN_UNTIL_CTRL_C
from grader.package.edit.tree import Replace, Write

from .model import INNER, NODE, right

TEXT = "'Hello time: ' + str(self.counter_)"
LINE = f"self.get_logger().info({TEXT})"
TIMER = "self.create_timer(1.0, self.timer_callback)"
COUNT = "self.counter_ = 0"
STEP = "self.counter_ += 1"
CATCH = SPIN_UNTIL_CTRL_C
CATCH_ANY = """\
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
"""
NO_CLASS = """\
#!/usr/bin/env python3
import rclpy


def main():
    rclpy.init()
    node = rclpy.create_node('my_first_node')
    count = 0

    def hello():
        nonlocal count
        node.get_logger().info(f'Hello time: {count}')
        count += 1

    node.create_timer(1, hello)
    rclpy.spin(node)


if __name__ == '__main__':
    main()
"""
SHORT = """\
#!/usr/bin/env python3
from .hello import main

if __name__ == '__main__':
    main()
"""
HELPER = """\
from rclpy.node import Node


class Counting(Node):

    def __init__(self, name, text, period):
        super().__init__(name)
        self._n = 0
        self._text = text
        self.create_timer(period, self._tick)

    def _tick(self):
        self.get_logger().info(self._text.format(self._n))
        self._n += 1
"""
INHERITS = """\
#!/usr/bin/env python3
import rclpy
from my_robot_controller.counting import Counting


def main(args=None):
    rclpy.init(args=args)
    rclpy.spin(Counting('my_first_node', 'Hello time: {}', 1.0))


if __name__ == '__main__':
    main()
"""
DATACLASS = """\
#!/usr/bin/env python3
from dataclasses import dataclass

import rclpy
from rclpy.node import Node


@dataclass
class Counter:
    value: int = 0

    def next(self) -> int:
        value = self.value
        self.value += 1
        return value


class MyFirstNode(Node):
    def __init__(self) -> None:
        super().__init__(node_name='my_first_node')
        self.state: Counter = Counter()
        self.timer_ = self.create_timer(1.0, self.hello)

    def hello(self) -> None:
        message: str = f'Hello time: {self.state.next()}'
        self.get_logger().info(message)


def main(args: 'list[str] | None' = None) -> None:
    rclpy.init(args=args)
    node: Node = MyFirstNode()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        node.get_logger().info('Bye')
    node.destroy_node()
    rclpy.try_shutdown()


if __name__ == '__main__':
    main()
"""

COUNTING = (
    right("solution", note="the reference solution itself"),
    right(
        "tutorial",
        Replace(NODE, "    finally:\n        node.destroy_node()\n", "    node.destroy_node()\n"),
        Replace(NODE, "        rclpy.try_shutdown()", "    rclpy.shutdown()"),
        note="the tutorial's own ending: an RCLError traceback and status 1 on jazzy",
    ),
    right("text_f_string", Replace(NODE, TEXT, "f'Hello time: {self.counter_}'")),
    right("text_percent", Replace(NODE, TEXT, "'Hello time: %d' % self.counter_")),
    right("text_format", Replace(NODE, TEXT, "'Hello time: {}'.format(self.counter_)")),
    right(
        "text_in_parts",
        Replace(NODE, LINE, f"text = {TEXT}\n        logger = self.get_logger()\n"
                "        logger.info(text)"),
    ),
    right("other_class_name", Replace(NODE, "class MyFirstNode(", "class Greeter("),
          Replace(NODE, "= MyFirstNode()", "= Greeter()")),
    right("no_class", Write(NODE, NO_CLASS), note="a function and rclpy.create_node"),
    right("other_module", Write(NODE, SHORT), Write(f"{INNER}/hello.py", NO_CLASS)),
    right("base_class_of_ours", Write(NODE, INHERITS), Write(f"{INNER}/counting.py", HELPER)),
    right("dataclass_and_hints", Write(NODE, DATACLASS)),
    right("itertools_count", Replace(NODE, "import rclpy\n", "import itertools\n\nimport rclpy\n"),
          Replace(NODE, COUNT, "self.counter_ = itertools.count()"),
          Replace(NODE, "str(self.counter_)", "str(next(self.counter_))"),
          Replace(NODE, f"\n        {STEP}", "")),
    right("counter_in_class",
          Replace(NODE, "    def __init__", '    counter_ = 0\n\n    def __init__'),
          Replace(NODE, f"        {COUNT}\n", "")),
    right("counts_before_logging", Replace(NODE, COUNT, "self.counter_ = -1"),
          Replace(NODE, f"        {LINE}\n        {STEP}", f"        {STEP}\n        {LINE}")),
    right("start_up_line", Replace(NODE, TIMER, f"{TIMER}\n        self.get_logger().info("
          "'my_first_node has been started')"), note="32 of 147 public packages do"),
    right("debug_lines",
          Replace(NODE, STEP, f"{STEP}\n        self.get_logger().debug('counted')")),
    right("says_bye", Replace(NODE, "        pass\n", "        print('Bye')\n")),
    right("no_try", Replace(NODE, CATCH, "    rclpy.spin(node)\n    node.destroy_node()\n"
          "    rclpy.shutdown()\n"), note="it ends with the KeyboardInterrupt traceback"),
    right("only_spin", Replace(NODE, CATCH, "    rclpy.spin(node)\n")),
    right("second_node_in_spin", Replace(NODE, "rclpy.spin(node)", "rclpy.spin(MyFirstNode())"),
          note="the first node is never spun; advice"),
    right("shutdown_not_called", Replace(NODE, "rclpy.try_shutdown()", "rclpy.shutdown"),
          note="brackets forgotten; 3 of 147, harmless"),
    right("if_ok_shutdown", Replace(NODE, "        rclpy.try_shutdown()",
          "        if rclpy.ok():\n            rclpy.shutdown()")),
    right("external_shutdown_caught",
          Replace(NODE, "import rclpy\nfrom", "import rclpy\nfrom rclpy.executors import "
                  "ExternalShutdownException\nfrom"),
          Replace(NODE, CATCH[: CATCH.index("    finally")], CATCH_ANY)),
    right("bare_except", Replace(NODE, "except KeyboardInterrupt:", "except:")),
    right("node_module_only", Replace(NODE, "from rclpy.node import Node", "import rclpy.node"),
          Replace(NODE, "class MyFirstNode(Node)", "class MyFirstNode(rclpy.node.Node)")),
    right("no_main_guard", Replace(NODE, "\n\nif __name__ == '__main__':\n    main()\n", "")),
    right("main_without_args", Replace(NODE, "def main(args=None)", "def main()"),
          Replace(NODE, "rclpy.init(args=args)", "rclpy.init()")),
    right("argv_given", Replace(NODE, "import rclpy\nfrom", "import sys\n\nimport rclpy\nfrom"),
          Replace(NODE, "rclpy.init(args=args)", "rclpy.init(args=sys.argv)")),
    right("umlauts", Replace(NODE, "        pass\n", "        pass  # Schluß für heute, 再见\n"),
          Replace("package.xml", ">student<", ">Jörg Müller<"),
          Replace("setup.py", "='student'", "='Jörg Müller'")),
)  # fmt: skip
