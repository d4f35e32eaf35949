"""Nodes that never spin, or that count beside spin; and nodes that count under another name."""

from __future__ import annotations

from collections.abc import Mapping

from grader.validate.tree import Edit, Replace, Write

from .model import NODE, Package, broken
from .right_node import CATCH, STEP, TEXT, TIMER

LOOP = """\
    try:
        while rclpy.ok():
            time.sleep(1.0)
            node.timer_callback()
    except KeyboardInterrupt:
        pass
    rclpy.try_shutdown()
"""
BESIDE = f"""\
    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
{LOOP}"""
SPIN_ONCE = LOOP.replace(
    "time.sleep(1.0)\n", "time.sleep(1.0)\n            rclpy.spin_once(node, timeout_sec=0)\n"
)
IDLE = LOOP.replace("            node.timer_callback()\n", "")
PROCEDURAL = """\
#!/usr/bin/env python3
import time

import rclpy


def main():
    rclpy.init()
    node = rclpy.create_node('my_first_node')
    n = 0
    while rclpy.ok():
        time.sleep(1)
        node.get_logger().info('Hello time: ' + str(n))
        n += 1


main() if __name__ == '__main__' else None
"""
AGAIN = "timer = threading.Timer(1.0, self.timer_callback)\n        timer.daemon = True\n        timer.start()"
SUPER = "super().__init__('my_first_node')"
MADE = "    node = MyFirstNode()\n"
INIT = "rclpy.init(args=args)"
STEADY = (
    "self.create_timer(1.0, self.timer_callback, clock=Clock(clock_type=ClockType.STEADY_TIME))"
)
HELPER = "    other = Node('my_first_node')\n"


def _node(old: str, new: str) -> Edit:
    return Replace(NODE, old, new)


def _imports(*lines: str) -> Edit:
    return _node(
        "import rclpy\nfrom", "".join(f"{line}\n" for line in lines) + "import rclpy\nfrom"
    )


def _unspun(
    name: str,
    *edits: Edit,
    mistake: str = "node.sleep_loop",
    also: Mapping[str, str] | None = None,
    score: float = 90,
    note: str = "",
) -> Package:
    failed = {"run.spins": mistake, **(also or {})}
    return broken(name, *edits, failed=failed, score=score, note=note)


def _loop(new: str = LOOP) -> tuple[Edit, ...]:
    return (
        _imports("import threading", "import time"),
        _node(TIMER, "pass"),
        _node(CATCH, new),
    )


SPIN = (
    _unspun("sleep_loop", *_loop(), note="right lines and times, but no callback is ever called"),
    _unspun("procedural_sleep", Write(NODE, PROCEDURAL, 0o755),
            note="ends with the KeyboardInterrupt traceback"),
    _unspun("sleep_loop_without_arguments", *_loop(), _node(INIT, "rclpy.init(args=[])"),
            note="use_sim_time does not reach it"),
    _unspun("sleep_loop_without_parameter_services", *_loop(),
            _node(SUPER, "super().__init__('my_first_node', start_parameter_services=False)")),
    _unspun("sleep_loop_beside_spin", *_loop(BESIDE), note="it answers, but ROS time stands still"),
    _unspun("sleep_loop_beside_spin_without_arguments", *_loop(BESIDE),
            _node(INIT, "rclpy.init(args=[])"),
            note="its parameter service sets use_sim_time, and the lines go on"),
    _unspun("short_sleep_loop_beside_spin", *_loop(BESIDE.replace("sleep(1.0)", "sleep(0.1)")),
            also={"run.period": "run.wrong_period"}, score=86,
            note="a line soon after each barrier seems to be on time"),
    _unspun("spin_once_in_a_sleep_loop", *_loop(SPIN_ONCE)),
    _unspun("thread_timer", _imports("import threading"), _node(TIMER, AGAIN),
            _node(STEP, f"{STEP}\n        {AGAIN}"), mistake="run.never_spins"),
    _unspun("sleep_loop_of_two_nodes", *_loop(),
            _node(MADE, "    other = Node('other_node')\n"
                  "    threading.Thread(target=rclpy.spin, args=(other,), daemon=True).start()\n"
                  + MADE),
            note="another node spins, the one that counts does not"),
    broken("timer_and_sleep_loop", _imports("import time"), _node(CATCH, IDLE),
           failed={"run.spins": "node.sleep_loop"},
           skipped=frozenset({"run.output", "run.logger", "run.period"}), score=73,
           note="the timer is there, and nothing calls it"),
    broken("steady_timer", _imports("from rclpy.clock import Clock",
                                    "from rclpy.clock import ClockType"), _node(TIMER, STEADY),
           failed={"run.period": "run.other_clock"}, score=96, note="subscribes to /clock anyway"),
    broken("another_node_has_the_name", _node(MADE, HELPER + MADE), _node(SUPER,
           "super().__init__('my_node')"), failed={"run.node_name": "run.wrong_node_name"},
           score=95, note="the node that counts is judged"),
    *(
        broken(f"period_{word}_and_text", _node("(1.0,", f"({seconds},"),
               _node(TEXT, "'Hello World ' + str(self.counter_)"),
               failed={"run.output": "run.wrong_text", "run.period": "run.wrong_period"}, score=86)
        for word, seconds in (("tenth", 0.1), ("half", 0.5), ("two", 2.0))
    ),
    broken("period_half_and_constant_text", _node("(1.0,", "(0.5,"), _node(TEXT, "'Hello World'"),
           failed={"run.output": "run.wrong_text", "run.period": "run.wrong_period"}, score=86),
)  # fmt: skip
