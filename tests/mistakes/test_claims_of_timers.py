"""What is said about timers, callbacks and loops is true of differently written programs too."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.mistakes.recognised import RecognisedMistake
from grader.package.source.small_changes import small_changes
from grader.package.source.small_values import Goal
from tests.mistakes.test_from_source import line_of, look, node_in, raised
from tests.mistakes.test_named_exactly import changed, fix_of, patched, why_of

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


def test_a_sleep_is_not_said_to_stop_other_threads(tmp_path: Path) -> None:
    text = changed(TIME, THREADS, (STEP, f"{STEP}        time.sleep(2)\n"))
    found = look("run.wrong_period", text)
    assert kind_of(found) == "node.sleeps_in_callback"
    assert "nothing else" not in why_of(found)
    assert "time.sleep" not in patched(found, text, tmp_path)


def test_a_sleep_that_is_all_of_a_method_leaves_a_pass(tmp_path: Path) -> None:
    helper = "\n    def rest(self):\n        time.sleep(2)\n"
    text = changed(TIME, (STEP, f"{STEP}        self.rest()\n{helper}"))
    new = patched(look("run.wrong_period", text), text, tmp_path)
    assert new == text.replace("time.sleep(2)", "pass")


def test_a_question_that_nothing_uses_is_deleted(tmp_path: Path) -> None:
    text = changed((LOG, f"        name = input('Name: ')\n{LOG}"))
    found = look("run.no_lines", text)
    assert patched(found, text, tmp_path) == changed()
    used = text.replace("'Hello time: '", "name")
    assert not patched(look("run.no_lines", used), used, tmp_path)


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
    assert kind_of(found) == "node.period_milliseconds"


@pytest.mark.parametrize("spun", [True, False])
def test_a_loop_in_the_constructor_is_not_said_to_be_above_a_spin(spun: bool) -> None:
    loop = f"        while True:\n    {LOG}    {STEP}            time.sleep(1)\n"
    edits = [TIME, (TIMER, loop)] + ([] if spun else [(SPIN, "        print(node)\n")])
    found = look("run.never_spins", changed(*edits))
    assert kind_of(found) == "node.constructor_repeats"
    assert ("then spins it" in why_of(found)) == spun
    assert ("call rclpy.spin with the node in main" in fix_of(found)) != spun


def test_the_level_of_another_logger_hides_no_lines() -> None:
    level = "        rclpy.logging.set_logger_level('{}', rclpy.logging.LoggingSeverity.WARN)\n"
    for name, hides in (("rcl", False), ("my_first_node", True)):
        found = look("run.no_lines", changed((START, START + level.format(name))))
        assert (kind_of(found) == "node.level_set") == hides
    other = "        rclpy.logging.get_logger('rcl').set_level(40)\n"
    assert kind_of(look("run.no_lines", changed((START, START + other)))) != "node.level_set"


def test_a_comparison_that_does_nothing_is_named_before_the_condition(tmp_path: Path) -> None:
    start = "    def start(self):\n        self.on == True\n\n"
    text = changed((START, f"{START}        self.on = False\n"), (DEF, start + DEF),
                   (BODY, f"        self.start()\n        if self.on:\n    {LOG}    {STEP}"))  # fmt: skip
    found = look("run.no_lines", text)
    assert kind_of(found) == "node.compared_not_assigned"
    assert "keeps the value that it has" in why_of(found)
    assert fix_of(found).endswith("self.on = True")
    assert patched(found, text, tmp_path) == text.replace("self.on == True", "self.on = True")
    both = text.replace("self.on == True\n", "self.on == True\n        self.counter_ == 0\n")
    assert kind_of(look("run.no_lines", both)) == ""


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


@pytest.mark.parametrize("value", ["None", "False"])
def test_a_flag_is_not_asked_for_none(value: str) -> None:
    text = changed(
        (START, f"{START}        self.on = {value}\n"), (LOG, f"        if self.on:\n    {LOG}")
    )
    source = node_in(text)
    goal = Goal("Hello time: ", "", 0, 1, 1.0)
    texts = [change.text for change in small_changes(source, goal)]
    assert any("self.on is not None" in each for each in texts) == (value == "None")


@pytest.mark.parametrize(
    "text", ["'Hello time: ' + str(self.counter_)", "f'Hello {1}' + self.counter_"]
)
def test_a_text_with_the_counter_is_no_sum_under_another_name(text: str) -> None:
    made = f"        text = {text}\n        self.get_logger().info(text)\n"
    assert kind_of(look("run.constant_counter", changed((BODY, made)))) != "node.counter_other_name"
