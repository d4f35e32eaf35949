"""The node beside other nodes, without services, or with its logger and timer elsewhere."""

from __future__ import annotations

from grader.package.edit.tree import Edit, Replace, Write

from .model import INNER, NODE, right
from .right_node import CATCH, COUNT, LINE, TEXT, TIMER

MADE = "    node = MyFirstNode()\n"
SUPER = "super().__init__('my_first_node')"
BARE = (
    "super().__init__('my_first_node', start_parameter_services=False, parameter_overrides="
    "[Parameter('start_type_description_service', value=False)])"
)
IN_THREAD = """\
    other = Node('other_node')
    executor = SingleThreadedExecutor()
    executor.add_node(other)
    threading.Thread(target=executor.spin, daemon=True).start()
"""
TICKER = """\
class Ticker:
    \"\"\"Counts for a node, which it is not itself.\"\"\"

    def __init__(self, node, logger):
        self.count = 0
        self.logger = logger
        self.timer = node.create_timer(1.0, self.tick)

    def tick(self):
        self.logger.info(f'Hello time: {self.count}')
        self.count += 1
"""
PARSER = """\
    parser = argparse.ArgumentParser()
    parser.add_argument('--verbose', action='store_true')
    parser.parse_args()
"""
NO_ARGUMENTS = """\
    if len(sys.argv) > 1:
        sys.exit('usage: test_node')
"""
COMPOSED = f"""\
#!/usr/bin/env python3
import rclpy
from rclpy.node import Node

from my_robot_controller.ticker import Ticker


def main(args=None):
    rclpy.init(args=args)
    node = Node('my_first_node')
    ticker = Ticker(node, node.get_logger())
{CATCH.replace("        pass", "        del ticker")}

if __name__ == '__main__':
    main()
"""


def _node(old: str, new: str) -> Edit:
    return Replace(NODE, old, new)


def _imports(*lines: str) -> Edit:
    return _node("import rclpy\n", "".join(f"{line}\n" for line in lines) + "import rclpy\n")


def _before(code: str) -> Edit:
    return _node(MADE, code + MADE)


NODES = (
    right("helper_node_first", _before("    other = Node('other_node')\n"),
          note="made first and never spun: on a terminal the other counts"),
    right("helper_node_after", _node(MADE, MADE + "    other = Node('other_node')\n")),
    right("three_helper_nodes",
          _before("    others = [Node(f'other_{n}') for n in range(3)]\n"
                  "    others[0].get_logger().info('made')\n")),
    right("helper_node_spun_in_a_thread", _before(IN_THREAD),
          _imports("import threading", "from rclpy.executors import SingleThreadedExecutor")),
    right("helper_node_without_services",
          _before("    other = Node('other_node', start_parameter_services=False)\n")),
    right("helper_node_on_the_wall_clock",
          _before("    other = Node('other_node', use_global_arguments=False)\n")),
    right("helper_node_of_the_same_class",
          _node("    def __init__(self):", "    def __init__(self, name='my_first_node'):"),
          _node(SUPER, "super().__init__(name)"), _before("    spare = MyFirstNode('spare')\n")),
    right("no_parameter_services",
          _node(SUPER, "super().__init__('my_first_node', start_parameter_services=False)"),
          note="its type description service answers instead (from jazzy on)"),
    right("no_services", _imports("from rclpy.parameter import Parameter"), _node(SUPER, BARE),
          note="only /clock can tell that it spins"),
    right("no_global_arguments",
          _node(SUPER, "super().__init__('my_first_node', use_global_arguments=False)"),
          wall_clock=True, note="use_sim_time reaches it through its parameter service only"),
    right("logger_of_the_module",
          _node("class MyFirstNode", "logger = None\n\n\nclass MyFirstNode"),
          _node(COUNT, f"{COUNT}\n        global logger\n        logger = self.get_logger()"),
          _node(LINE, f"logger.info({TEXT})")),
    right("logger_given_to_a_helper",
          _node("class MyFirstNode", "class Speaker:\n    def __init__(self, logger):\n"
                "        self.info = logger.info\n\n\nclass MyFirstNode"),
          _node(COUNT, f"{COUNT}\n        self.speaker = Speaker(self.get_logger())"),
          _node(LINE, f"self.speaker.info({TEXT})")),
    right("helper_class_with_the_timer", Write(NODE, COMPOSED, 0o755),
          Write(f"{INNER}/ticker.py", TICKER)),
    right("argparse_refuses_ros_arguments", _imports("import argparse"), _before(PARSER),
          wall_clock=True, note="a person at a terminal gives no arguments"),
    right("usage_without_arguments_only", _imports("import sys"), _before(NO_ARGUMENTS),
          wall_clock=True),
    right("start_from_the_number_of_arguments", _imports("import sys"),
          _node(COUNT, "self.counter_ = len(sys.argv) - 1"), wall_clock=True,
          note="starts at 0 only without arguments"),
    right("timer_of_a_helper_module",
          Write(f"{INNER}/start.py", "def start(node, callback):\n"
                "    return node.create_timer(1.0, callback)\n"),
          _imports("from my_robot_controller.start import start"),
          _node(TIMER, "self.timer = start(self, self.timer_callback)")),
)  # fmt: skip
