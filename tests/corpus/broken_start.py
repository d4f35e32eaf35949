"""Nodes that do not start, or end soon after."""

from __future__ import annotations

from grader.validate.tree import Edit, Replace, Write

from .model import AFTER_START, NODE, Package, broken
from .right_node import CATCH, COUNT, TIMER

SUPER = "        super().__init__('my_first_node')\n"
MADE = "    node = MyFirstNode()\n"
INIT = "    rclpy.init(args=args)\n"
HELLO = """\
#!/usr/bin/env python3
def main():
    for n in range(10):
        print(f'Hello time: {n}')
"""


def _dies(name: str, mistake: str, *edits: Edit, note: str = "") -> Package:
    return broken(
        name, *edits, failed={"run.starts": mistake}, skipped=AFTER_START, score=60, note=note
    )


def _node(old: str, new: str) -> Edit:
    return Replace(NODE, old, new)


START = (
    _dies("import_misspelt", "node.import_misspelt",
          _node("import rclpy\nfrom", "import rclpi\nfrom")),
    _dies("import_of_node", "node.import_node",
          _node("from rclpy.node import Node", "from rclpy import Node")),
    _dies("import_unknown", "node.import_misspelt",
          _node("import rclpy\nfrom", "import numpi as np\nimport rclpy\nfrom")),
    _dies("import_node_missing", "node.import_missing", _node("from rclpy.node import Node\n", ""),
          note="NameError while the class is defined"),
    _dies("raises_at_import", "run.died_at_start",
          _node("class MyFirstNode", "raise OSError('boom')\n\n\nclass "
          "MyFirstNode")),
    _dies("super_missing", "node.super_missing", _node(SUPER, "")),
    _dies("super_after_timer", "node.super_late", _node(SUPER, ""), _node(f"        {TIMER}\n",
          f"        {TIMER}\n{SUPER}")),
    _dies("super_without_name", "node.super_without_name",
          _node("__init__('my_first_node')", "__init__()")),
    _dies("init_single_underscores", "node.init_underscores",
          _node("    def __init__(self)", "    def _init_(self)")),
    _dies("not_a_node", "node.not_a_node", _node("class MyFirstNode(Node)", "class MyFirstNode")),
    _dies("dash_in_node_name", "node.name_invalid", _node("'my_first_node'", "'my-first-node'")),
    _dies("blank_in_node_name", "node.name_invalid", _node("'my_first_node'", "'my first node'")),
    _dies("rclpy_init_missing", "node.init_missing", _node(INIT, "")),
    _dies("rclpy_init_after_node", "node.init_late", _node(INIT + MADE, MADE + INIT)),
    _dies("main_missing", "node.main_missing",
          _node("def main(", "def run("), _node("\n    main()\n", "\n    run()\n")),
    _dies("main_misspelt", "node.main_misspelt", _node("def main(", "def mein("),
          _node("\n    main()\n", "\n    mein()\n")),
    _dies("main_wants_args", "node.main_wants_args",
          _node("def main(args=None)", "def main(args)")),
    _dies("callback_misspelt", "node.callback_misspelt",
          _node(TIMER, TIMER.replace("timer_callback", "timer_calback"))),
    _dies("callback_without_self_dot", "node.callback_without_self_dot",
          _node("self.timer_callback", "timer_callback")),
    _dies("callback_inside_init", "node.callback_in_init", _node("    def timer_callback(self)",
          "        def timer_callback(self)"),
          _node('        """Say hello once; the timer calls this for as long as the node '
                'spins."""\n'
                "        self.get_logger().info('Hello time: ' + str(self.counter_))\n"
                "        self.counter_ += 1\n",
                "            self.get_logger().info('Hello time: ' + str(self.counter_))\n"
                "            self.counter_ += 1\n")),
    _dies("timer_at_class_level", "node.timer_at_class_level",
          _node(f"        {TIMER}\n", f"\n    {TIMER}\n")),
    _dies("timer_arguments_swapped", "node.timer_arguments_swapped",
          _node("1.0, self.timer_callback", "self.timer_callback, 1.0")),
    _dies("period_as_text", "node.period_text", _node("(1.0,", "('1.0s',")),
    _dies("period_missing", "node.timer_argument_missing", _node("(1.0, self", "(self")),
    _dies("create_timer_misspelt", "node.method_misspelt", _node("create_timer", "create_timmer")),
    _dies("context_manager_of_kilted", "node.context_manager",
          _node(INIT + MADE + CATCH, "    with rclpy.init(args=args):\n"
                                     "        rclpy.spin(MyFirstNode())\n"),
          note="the newer tutorial on jazzy; right from kilted on"),
    _dies("spin_of_class", "node.spin_of_class",
          _node("rclpy.spin(node)", "rclpy.spin(MyFirstNode)")),
    _dies("exception_in_init", "run.died_at_start", _node(COUNT, "self.counter_ = int('zero')")),
    _dies("spin_missing", "node.spin_missing",
          _node("        rclpy.spin(node)\n", "        pass\n")),
    _dies("spin_not_called", "node.spin_not_called", _node("rclpy.spin(node)", "rclpy.spin")),
    _dies("spin_once", "node.spin_once", _node("rclpy.spin(node)", "rclpy.spin_once(node)"),
          note="one line on the wall clock; none under use_sim_time, because the first message on "
          "/clock is the only callback that it runs"),
    _dies("main_empty", "node.main_empty", _node(INIT + MADE + CATCH, "    pass\n")),
    _dies("loop_without_node", "node.no_ros", Write(NODE, HELLO),
          note="ten lines at once, without ROS"),
    _dies("waits_for_input", "node.waits_first",
          _node(INIT, "    input('Press Enter to start')\n" + INIT)),
    _dies("sleeps_before_init", "node.waits_first",
          _node(INIT, "    import time\n    time.sleep(3600)\n" + INIT)),
    _dies("loop_without_ros", "node.no_ros",
          Write(NODE, HELLO.replace("def main():\n", "import time\n\n\n"
          "def main():\n").replace("range(10)", "range(10**6)") + "        time.sleep(1)\n"),
          note="right lines at right instants, but no node"),
)  # fmt: skip
