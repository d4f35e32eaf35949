"""What is said about timers, callbacks and loops is true of differently written programs too."""

from __future__ import annotations

import pytest

from grader.mistakes.recognised import RecognisedMistake
from tests.mistakes.test_from_source import line_of, look, raised
from tests.mistakes.test_named_exactly import changed

TIMER = "        self.create_timer(1.0, self.timer_callback)\n"
DEF = "    def timer_callback(self):\n"
LOG = "        self.get_logger().info('Hello time: ' + str(self.counter_))\n"
STEP = "        self.counter_ += 1\n"
START = "        self.counter_ = 0\n"
BODY = LOG + STEP
IMPORT = "import rclpy\nfrom"
TIME = (IMPORT, "import time\n\nimport rclpy\nfrom")
SPIN = "        rclpy.spin(node)\n"
THREADS = (
    SPIN,
    "        executor = rclpy.executors.MultiThreadedExecutor()\n"
    "        executor.add_node(node)\n        executor.spin()\n",
)


def kind_of(found: RecognisedMistake | None) -> str:
    return found.kind if found is not None else ""


def test_a_call_that_returns_the_callback_is_none_too_many() -> None:
    body = (
        "        def callback():\n            pass\n        callback()\n        return callback\n"
    )
    text = changed(
        ("self.timer_callback)", "self.make())"), (DEF, f"    def make(self):\n{body}\n{DEF}")
    )
    assert kind_of(look("run.by_hand", text)) != "node.callback_called"
    text = text.replace("        return callback\n", "")
    assert kind_of(look("run.by_hand", text)) == "node.callback_called"


def test_the_period_of_the_timer_that_logs_counts() -> None:
    first = "        self.first_ = self.create_timer(1.0, self.start)\n"
    start = (
        f"    def start(self):\n        self.first_.cancel()\n{TIMER.replace('1.0', '1000.0')}\n"
    )
    found = look("run.no_lines", changed((TIMER, first), (DEF, start + DEF)))
    assert kind_of(found) == "node.period_wrong"


def test_the_level_of_another_logger_hides_no_lines() -> None:
    level = "        rclpy.logging.set_logger_level('{}', rclpy.logging.LoggingSeverity.WARN)\n"
    for name, hides in (("rcl", False), ("my_first_node", True)):
        found = look("run.no_lines", changed((START, START + level.format(name))))
        assert (kind_of(found) == "node.debug_level") == hides
    other = "        rclpy.logging.get_logger('rcl').set_level(40)\n"
    assert kind_of(look("run.no_lines", changed((START, START + other)))) != "node.debug_level"


def test_a_static_method_is_not_said_to_get_self() -> None:
    static = "    @staticmethod\n    def word():\n        return 'Hello time: '\n\n"
    text = changed((DEF, static + DEF), ("'Hello time: ' + ", "self.word(0) + "))
    error = "TypeError: MyFirstNode.word() takes 0 positional arguments but 1 was given"
    assert kind_of(raised(error, text, line_of(text, "self.word(0)"))) != "node.callback_no_self"


@pytest.mark.parametrize("first", ["count", "timer_callback"])
def test_the_callback_is_that_of_the_timer_that_logs(first: str) -> None:
    other = "count" if first == "timer_callback" else "timer_callback"
    timers = "".join(TIMER.replace("timer_callback", name) for name in (first, other))
    count = "    def count(self):\n        self.other_ = 1\n\n"
    text = changed(
        (TIMER, timers), (DEF, count + DEF), (LOG, f"        if self.counter_ > 3:\n    {LOG}")
    )
    assert kind_of(look("run.no_lines", text.replace(".info(", ".debug("))) == "node.debug_level"


@pytest.mark.parametrize(
    "text", ["'Hello time: ' + str(self.counter_)", "f'Hello {1}' + self.counter_"]
)
def test_a_text_with_the_counter_is_no_sum_under_another_name(text: str) -> None:
    made = f"        text = {text}\n        self.get_logger().info(text)\n"
    assert kind_of(look("run.constant_counter", changed((BODY, made)))) != "node.counter_other_name"
