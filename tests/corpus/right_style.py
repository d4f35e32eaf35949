"""The same node in other styles: context managers, imports, modules, ways to end."""

from __future__ import annotations

from grader.package.edit.tree import Edit, Replace, Write

from .model import INNER, NODE, SETUP, right
from .right_node import CATCH, COUNT, LINE, NO_CLASS, STEP, TEXT, TIMER

SUPER = "super().__init__('my_first_node')"
BODY = "    rclpy.init(args=args)\n    node = MyFirstNode()\n" + CATCH
SUPPRESSED = """\
    with contextlib.suppress(KeyboardInterrupt):
        rclpy.spin(node)
    node.destroy_node()
    rclpy.try_shutdown()
"""
OWN_CONTEXT = """\
    with ros(args):
        rclpy.spin(MyFirstNode())
"""
CONTEXT = """\
@contextlib.contextmanager
def ros(args):
    rclpy.init(args=args)
    try:
        yield
    except KeyboardInterrupt:
        pass
    finally:
        rclpy.try_shutdown()


def main(args=None)"""
IN_WITH = """\
    try:
        with SingleThreadedExecutor() as executor:
            executor.add_node(node)
            executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
"""
EXIT_STACK = """\
    with contextlib.ExitStack() as stack:
        rclpy.init(args=args)
        stack.callback(rclpy.try_shutdown)
        node = MyFirstNode()
        stack.callback(node.destroy_node)
        stack.enter_context(contextlib.suppress(KeyboardInterrupt))
        rclpy.spin(node)
"""
WHILE_OK = """\
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(node)
    try:
        while rclpy.ok():
            executor.spin_once(timeout_sec=0.5)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    executor.shutdown()
"""
COMPACT = """\
#!/usr/bin/env python3
import rclpy; from rclpy.node import Node
class N(Node):
\tdef __init__(self):
\t\tNode.__init__(self, 'my_first_node'); self.n = 0; self.t = self.create_timer(1, self.c)
\tdef c(self):
\t\tself.get_logger().info('Hello time: %i' % self.n); self.n = self.n + 1
def main():
\trclpy.init(); n = N()
\ttry: rclpy.spin(n)
\texcept KeyboardInterrupt: pass
"""
GENERATOR = """\
self.lines_ = (f'Hello time: {n}' for n in itertools.count())"""
PARAMETER = """\
self.declare_parameter('period', 1.0)
        period = self.get_parameter('period').value
        self.create_timer(period, self.timer_callback)"""


def _node(old: str, new: str) -> Edit:
    return Replace(NODE, old, new)


def _imports(*lines: str) -> Edit:
    return _node(
        "import rclpy\nfrom", "".join(f"{line}\n" for line in (*lines, "import rclpy")) + "from"
    )


def _text(new: str) -> Edit:
    return _node(TEXT, new)


STYLE = (
    right("suppressed_interrupt", _imports("import contextlib", ""), _node(CATCH, SUPPRESSED)),
    right("context_manager_of_ones_own", _imports("import contextlib", ""),
          _node("def main(args=None)", CONTEXT), _node(BODY, OWN_CONTEXT)),
    right("exit_stack", _imports("import contextlib", ""), _node(BODY, EXIT_STACK)),
    right("executor_in_with", _node(CATCH, IN_WITH),
          _imports("from rclpy.executors import ExternalShutdownException",
                   "from rclpy.executors import SingleThreadedExecutor")),
    right("executor_spins_once_in_a_loop", _node(CATCH, WHILE_OK),
          _imports("from rclpy.executors import ExternalShutdownException",
                   "from rclpy.executors import MultiThreadedExecutor")),
    right("spin_with_executor", _imports("from rclpy.executors import MultiThreadedExecutor"),
          _node("rclpy.spin(node)", "rclpy.spin(node, executor=MultiThreadedExecutor())")),
    right("mutually_exclusive_group",
          _imports("from rclpy.callback_groups import MutuallyExclusiveCallbackGroup"),
          _node(TIMER, "self.group_ = MutuallyExclusiveCallbackGroup()\n        self.timer_ = "
                "self.create_timer(1.0, self.timer_callback, self.group_)")),
    right("waits_for_a_future", _imports("from rclpy.task import Future"),
          _node("rclpy.spin(node)", "rclpy.spin_until_future_complete(node, Future())")),
    right("node_made_in_spin", _node("    node = MyFirstNode()\n", ""), _node(CATCH,
          "    try:\n        rclpy.spin(MyFirstNode())\n    except KeyboardInterrupt:\n"
          "        pass\n    rclpy.try_shutdown()\n")),
    right("functions_imported", _node("import rclpy\nfrom rclpy.node",
          "from rclpy import init\nfrom rclpy import spin\nfrom rclpy import try_shutdown\n"
          "from rclpy.node"), _node("rclpy.init(", "init("), _node("rclpy.spin(", "spin("),
          _node("rclpy.try_shutdown(", "try_shutdown(")),
    right("imported_as", _node("import rclpy\nfrom", "import rclpy as ros\nfrom"),
          _node("rclpy.init(", "ros.init("), _node("rclpy.spin(", "ros.spin("),
          _node("rclpy.try_shutdown(", "ros.try_shutdown(")),
    right("catches_exception", _node("except KeyboardInterrupt:", "except Exception:")),
    right("super_of_python_2", _node(SUPER, "super(MyFirstNode, self).__init__('my_first_node')")),
    right("base_named", _node(SUPER, "Node.__init__(self, 'my_first_node')")),
    right("name_by_keyword", _node(SUPER, "super().__init__(node_name='my_first_node')")),
    right("name_given_in_main", _node("def __init__(self)", "def __init__(self, name)"),
          _node(SUPER, "super().__init__(name)"),
          _node("MyFirstNode()", "MyFirstNode('my_first_node')")),
    right("period_in_class", _node("    def __init__", "    PERIOD = 1.0\n\n    def __init__"),
          _node("(1.0,", "(self.PERIOD,")),
    right("period_parameter", _node(TIMER, PARAMETER)),
    right("period_of_another_module", Write(f"{INNER}/settings.py", "PERIOD = 1.0\n"),
          _imports("from .settings import PERIOD"), _node("(1.0,", "(PERIOD,")),
    right("node_in_a_package_below", Write(NODE, "#!/usr/bin/env python3\n"
          "from my_robot_controller.nodes.hello import main\n\nmain() if __name__ == '__main__' "
          "else None\n"), Write(f"{INNER}/nodes/__init__.py", ""),
          Write(f"{INNER}/nodes/hello.py", NO_CLASS)),
    right("main_returns_a_status", _node("        rclpy.try_shutdown()\n",
          "        rclpy.try_shutdown()\n    return 0\n"),
          _node("    main()\n", "    raise SystemExit(main())\n")),
    right("text_joined", _text("' '.join(['Hello', 'time:', str(self.counter_)])")),
    right("text_by_template", _imports("from string import Template", ""),
          _text("Template('Hello time: $n').substitute(n=self.counter_)")),
    right("text_percent_s", _text("'%s: %s' % ('Hello time', self.counter_)")),
    right("text_debug_free_f_string", _text("f\"Hello time: {self.counter_!s}\"")),
    right("text_from_a_generator", _imports("import itertools", ""), _node(COUNT, GENERATOR),
          _node(f"{LINE}\n        {STEP}", "self.get_logger().info(next(self.lines_))")),
    right("logger_kept", _node(COUNT, f"{COUNT}\n        self.log_ = self.get_logger()"),
          _node(LINE, f"self.log_.info({TEXT})")),
    right("counter_written_out", _node(STEP, "self.counter_ = self.counter_ + 1")),
    right("counter_global", _node(f"        {COUNT}\n", ""),
          _node("class MyFirstNode", "counter = 0\n\n\nclass MyFirstNode"),
          _node(LINE, "global counter\n        self.get_logger().info(f'Hello time: {counter}')"),
          _node(STEP, "counter += 1")),
    right("compact_with_tabs", Write(NODE, COMPACT, 0o755)),
    right("latin_1_declared", Write(NODE, NO_CLASS.replace(
          "#!/usr/bin/env python3\n", "#!/usr/bin/env python3\n# -*- coding: latin-1 -*-\n"
          "# f\xfcr die erste \xdcbung\n").encode("latin-1"))),
    right("private_main", _node("def main(", "def _run("), _node("\n    main()\n", "\n    _run()\n"),
          _node("\n\nif __name__", "\n\nmain = _run\n\n\nif __name__"),
          note="main is there, but no def of that name"),
    right("setup_by_package_list", Replace(SETUP, "from setuptools import find_packages\n", ""),
          Replace(SETUP, "find_packages(exclude=['test'])", f"['{INNER}']")),
)  # fmt: skip
