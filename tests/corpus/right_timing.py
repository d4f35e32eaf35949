"""The node with other timers, executors, threads or clocks."""

from __future__ import annotations

from grader.package.edit.tree import Edit, Replace

from .model import NODE, right
from .right_node import CATCH, COUNT, LINE, STEP, TIMER

SPIN = "rclpy.spin(node)"


def _imports(*lines: str) -> Edit:
    return Replace(
        NODE, "import rclpy\n", "".join(f"{line}\n" for line in lines) + "import rclpy\n"
    )


def _timer(new: str) -> Edit:
    return Replace(NODE, TIMER, new)


def _spin(new: str) -> Edit:
    return Replace(NODE, SPIN, new)


def _executor(kind: str) -> tuple[Edit, ...]:
    return (
        _imports(f"from rclpy.executors import {kind}"),
        _spin(f"executor = {kind}()\n        executor.add_node(node)\n        executor.spin()"),
    )


GROUP = "self.create_timer(1.0, self.timer_callback, callback_group=ReentrantCallbackGroup())"
RATE = """\
    thread = threading.Thread(target=rclpy.spin, args=(node,), daemon=True)
    thread.start()
    rate = node.create_rate(1.0)
    try:
        while rclpy.ok():
            rate.sleep()
            node.timer_callback()
    except (KeyboardInterrupt, ROSInterruptException):
        pass
    rclpy.try_shutdown()
    thread.join()
"""
TENTHS = f"""\
        self.tenths += 1
        if self.tenths % 10 == 0:
            {LINE}
            {STEP}"""
HUNDREDTHS = TENTHS.replace("10 ==", "100 ==")
AT_MOST_TWICE_A_SECOND = f"""\
now = time.monotonic()
        if now - self.last < 0.5:
            return
        self.last = now
        {LINE}"""
TWO_NODES = """\
other = Node('my_idle_node')
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        executor.add_node(other)
        executor.spin()"""
THREAD = """\
    thread = threading.Thread(target=rclpy.spin, args=(node,), daemon=True)
    thread.start()
    try:
        threading.Event().wait()
    except KeyboardInterrupt:
        pass
    rclpy.try_shutdown()
    thread.join()
"""

TIMING = (
    right("period_int", _timer("timer_period = 1\n        self.create_timer(timer_period, "
          "self.timer_callback)")),
    right("timer_kept", _timer(f"self.timer = {TIMER}")),
    right("timer_keywords",
          _timer("self.create_timer(timer_period_sec=1.0, callback=self.timer_callback)")),
    right("timer_in_helper", _timer("self._start()\n\n    def _start(self):\n"
          f"        self._timer = {TIMER}")),
    right("timer_in_main", _timer("pass"),
          Replace(NODE, "node = MyFirstNode()", "node = MyFirstNode()\n"
                  "    node.create_timer(1.0, node.timer_callback)")),
    right("lambda_callback", _timer("self.create_timer(1.0, lambda: self.timer_callback())")),
    right("partial_callback", _imports("from functools import partial", ""),
          _timer("self.create_timer(1.0, partial(self.timer_callback, 'Hello time: '))"),
          Replace(NODE, "def timer_callback(self)", "def timer_callback(self, text)"),
          Replace(NODE, "'Hello time: ' + ", "text + ")),
    right("async_callback", Replace(NODE, "def timer_callback", "async def timer_callback")),
    right("reentrant_group",
          _imports("from rclpy.callback_groups import ReentrantCallbackGroup"), _timer(GROUP)),
    right("single_threaded_executor", *_executor("SingleThreadedExecutor")),
    right("multi_threaded_executor", *_executor("MultiThreadedExecutor")),
    right("reentrant_on_threads", *_executor("MultiThreadedExecutor"), _timer(GROUP),
          _imports("from rclpy.callback_groups import ReentrantCallbackGroup")),
    right("spin_once_loop", _spin("while rclpy.ok():\n            rclpy.spin_once(node)")),
    right("spin_once_timeout",
          _spin("while rclpy.ok():\n            rclpy.spin_once(node, timeout_sec=0.1)")),
    right("spin_in_thread", _imports("import threading", ""), Replace(NODE, CATCH, THREAD)),
    right("short_sleep_in_callback", _imports("import time", ""),
          Replace(NODE, STEP, f"{STEP}\n        time.sleep(0.05)")),
    right("two_nodes", _imports("from rclpy.executors import SingleThreadedExecutor"),
          _spin(TWO_NODES), note="an unrelated second node in the same program"),
    right("idle_second_timer", _timer(f"{TIMER}\n        self.create_timer(0.25, lambda: None)")),
    right("rate_in_main", _imports("import threading", ""), _timer("pass"),
          _imports("from rclpy.exceptions import ROSInterruptException"),
          Replace(NODE, CATCH, RATE),
          note="follows /clock, but the lines come from a thread unknown to the executor: "
          "an answered parameter request does not prove that a due line has come"),
    right("tenths", _timer("self.tenths = 0\n        self.create_timer(0.1, self.timer_callback)"),
          Replace(NODE, f"        {LINE}\n        {STEP}", TENTHS),
          note="ten short periods a line: a clock that jumps by a second skips nine of them"),
    right("hundredths", _timer("self.tenths = 0\n        self.create_timer(0.01, self.timer_callback)"),
          Replace(NODE, f"        {LINE}\n        {STEP}", HUNDREDTHS),
          note="a timer that is faster than the usual fine steps of the clock"),
    right("throttled_below_its_period",
          Replace(NODE, LINE, f"{LINE[:-1]}, throttle_duration_sec=0.5)"),
          note="the logger leaves out nothing in real time, but most lines on a faster clock"),
    right("asks_the_real_clock", _imports("import time", ""),
          Replace(NODE, COUNT, f"{COUNT}\n        self.last = 0.0"),
          Replace(NODE, LINE, AT_MOST_TWICE_A_SECOND)),
    right("escapes_sim_time", Replace(NODE, "rclpy.init(args=args)", "rclpy.init(args=[])"),
          wall_clock=True, note="use_sim_time never reaches it, but it is right"),
)  # fmt: skip
