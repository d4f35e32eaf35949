"""What is said about timers, callbacks and loops is true of differently written programs too."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from grader.mistakes.recognise import behind_symptom
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.source.small_changes import small_changes
from grader.package.source.small_values import Goal
from grader.report.model import Where
from tests.marking import ASSIGNMENT
from tests.mistakes.test_from_source import line_of, look, node_in, raised
from tests.mistakes.test_named_exactly import changed, fix_of, patched, why_of
from tests.static_bench import NODE

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


def test_a_loop_that_calls_the_callback_is_no_single_call(tmp_path: Path) -> None:
    call = "            self.timer_callback()\n"
    text = changed((TIMER, f"        for i in range(3):\n{call}"))
    found = look("run.stops", text)
    at = line_of(text, "for i in")
    assert "once. Only" not in why_of(found)
    assert why_of(found).startswith(f"The for of line {at} calls the method")
    assert fix_of(found).endswith(f"instead of the for of line {at} with its line.")
    assert patched(found, text, tmp_path) == changed()


def test_a_call_with_values_is_kept_for_the_timer(tmp_path: Path) -> None:
    text = changed((TIMER, "        self.timer_callback('Hello time: ')\n"), (DEF, DEF.replace(
        "self)", "self, text)")), ("'Hello time: ' + str", "text + str"))  # fmt: skip
    found = look("run.stops", text)
    new = "self.create_timer(1.0, lambda: self.timer_callback('Hello time: '))"
    assert fix_of(found) == f"Write {new} instead of self.timer_callback('Hello time: ')."
    assert new in patched(found, text, tmp_path)


SUBSCRIBED = "        self.create_subscription(String, 'hello', self.timer_callback, 10)\n"


@pytest.mark.parametrize(
    ("more", "published", "used"),
    [("", False, False), ("        self.pub.publish(String())\n", True, False),
     ("        self.pub.publish(msg)\n", True, True)],
)  # fmt: skip
def test_nothing_publishes_only_if_no_line_does(more: str, published: bool, used: bool) -> None:
    text = changed(
        (TIMER, SUBSCRIBED), (DEF, DEF.replace("self", "self, msg")), (STEP, STEP + more)
    )
    found = look("run.no_lines", text)
    assert ("nothing here publishes" in why_of(found)) != published
    assert fix_of(found).endswith("where timer_callback uses msg.") == used


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


def test_another_timers_callback_holds_up_only_one_thread() -> None:
    work = "\n    def work(self):\n        while self.counter_ < 5:\n            time.sleep(0.1)\n"
    edits = (TIME, (TIMER, TIMER + TIMER.replace("timer_callback", "work")), (STEP, STEP + work))
    found = look("run.no_lines", changed(*edits))
    assert found is not None
    assert (found.kind, found.variant) == ("node.callback_never_ends", "other")
    text = changed(*edits, THREADS).replace("while self.counter_ < 5", "while True")
    assert kind_of(look("run.no_lines", text)) != "node.callback_never_ends"


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


def test_the_counter_is_no_measured_time() -> None:
    block = (
        "        passed = int(time.time() - self.began)\n"
        f"        if passed > self.counter_:\n    {LOG}    {STEP}"
    )
    text = changed(TIME, ("(1.0,", "(0.1,"), (START, f"{START}        self.began = time.time()\n"),
                   (BODY, block))  # fmt: skip
    found = look("run.wrong_period", text)
    assert kind_of(found) != "node.measures_time"
    assert f"line {line_of(text, 'counter_ += 1')}" not in fix_of(found)


def test_the_reset_of_another_timer_is_replaced_by_pass(tmp_path: Path) -> None:
    edits = (
        TIMER,
        f"        self.timer_ = {TIMER.strip()}\n        self.create_timer(0.2, self.look)\n",
    )
    method = (
        "    def look(self):\n        if self.counter_ < 1:\n            self.timer_.reset()\n\n"
    )
    text = changed(edits, (DEF, method + DEF))
    found = look("run.no_lines", text)
    assert fix_of(found) == "Write pass instead of this line."
    assert patched(found, text, tmp_path) == text.replace("self.timer_.reset()", "pass")


def test_a_stop_that_is_all_of_a_method_is_replaced_by_pass(tmp_path: Path) -> None:
    kept = (TIMER, f"        self.timer_ = {TIMER.strip()}\n")
    method = (
        "    def stop(self):\n        if self.counter_ > 3:\n            self.timer_.cancel()\n\n"
    )
    text = changed(kept, (DEF, method + DEF), (STEP, f"{STEP}        self.stop()\n"))
    found = look("run.stops", text)
    assert fix_of(found) == "Write pass instead of this line."
    assert patched(found, text, tmp_path) == text.replace("self.timer_.cancel()", "pass")


@pytest.mark.parametrize("spun", [True, False])
def test_a_loop_in_the_constructor_is_not_said_to_be_above_a_spin(spun: bool) -> None:
    loop = f"        while True:\n    {LOG}    {STEP}            time.sleep(1)\n"
    edits = [TIME, (TIMER, loop)] + ([] if spun else [(SPIN, "        print(node)\n")])
    found = look("run.never_spins", changed(*edits))
    assert kind_of(found) == "node.constructor_repeats"
    assert ("then spins it" in why_of(found)) == spun
    assert ("call rclpy.spin with the node in main" in fix_of(found)) != spun


def test_a_loop_that_waits_in_a_method_of_the_constructor_is_deleted(tmp_path: Path) -> None:
    wait = (
        "    def wait(self):\n        while self.counter_ is None:\n            time.sleep(1)\n\n"
    )
    text = changed(TIME, (TIMER, f"{TIMER}        self.wait()\n"), (DEF, wait + DEF))
    found = look("run.never_spins", text)
    assert kind_of(found) == "node.constructor_repeats"
    new = patched(found, text, tmp_path)
    assert "        pass\n" in new
    assert "while self" not in new


@pytest.mark.parametrize(("test", "ends"), [("True", False), ("rclpy.ok()", True)])
def test_a_thread_that_ctrl_c_can_end_is_not_said_to_go_on(test: str, ends: bool) -> None:
    thread = "        threading.Thread(target=self.timer_callback).start()\n"
    loop = f"        while {test}:\n    {LOG}    {STEP}            time.sleep(1.0)\n"
    text = changed((IMPORT, "import threading\nimport time\nimport rclpy\nfrom"), (TIMER, thread),
                   (BODY, loop))  # fmt: skip
    for symptom in ("run.never_spins", "run.twice"):
        found = look(symptom, text)
        assert kind_of(found) == "node.thread_for_timer"
        assert ("but not this thread" in why_of(found)) != ends
    assert "but not this thread" in why_of(look("run.ignores_interrupt", text))


def test_a_timer_of_python_beside_the_nodes_own_is_not_to_be_replaced() -> None:
    off = "        threading.Timer(2.0, self.timer_.cancel).start()\n"
    text = changed((IMPORT, "import threading\n\nimport rclpy\nfrom"),
                   (TIMER, f"        self.timer_ = {TIMER.strip()}\n{off}"))  # fmt: skip
    assert kind_of(look("run.stops", text)) != "node.threading_timer"


def test_the_level_of_another_logger_hides_no_lines() -> None:
    level = "        rclpy.logging.set_logger_level('{}', rclpy.logging.LoggingSeverity.WARN)\n"
    for name, hides in (("rcl", False), ("my_first_node", True)):
        found = look("run.no_lines", changed((START, START + level.format(name))))
        assert (kind_of(found) == "node.level_set") == hides
    other = "        rclpy.logging.get_logger('rcl').set_level(40)\n"
    assert kind_of(look("run.no_lines", changed((START, START + other)))) != "node.level_set"


def test_a_value_for_each_argument_is_not_the_first_value(tmp_path: Path) -> None:
    method = "    @lru_cache\n    def text(self{}):\n        return 'Hello time: ' + str({})\n\n"
    text = changed((IMPORT, "from functools import lru_cache\n\nimport rclpy\nfrom"),
                   ("'Hello time: ' + str(self.counter_)", "self.text()"),
                   (DEF, method.format("", "self.counter_") + DEF))  # fmt: skip
    found = look("run.constant_counter", text)
    assert kind_of(found) == "node.value_cached"
    assert patched(found, text, tmp_path) == text.replace("    @lru_cache\n", "")
    text = text.replace("text(self)", "text(self, n)").replace("str(self.counter_)", "str(n)")
    text = text.replace("self.text()", "self.text(self.counter_)")
    assert kind_of(look("run.constant_counter", text)) != "node.value_cached"


def test_a_rate_may_wait_beside_other_threads() -> None:
    rate = (STEP, f"{STEP}        self.create_rate(1.0).sleep()\n")
    assert "nothing ever wakes it" in why_of(look("run.stops", changed(rate)))
    assert "nothing ever wakes it" not in why_of(look("run.stops", changed(rate, THREADS)))


def test_a_count_that_begins_in_the_constructor_ends_there_too(tmp_path: Path) -> None:
    text = changed((TIMER, TIMER + BODY))
    at = line_of(text, "create_timer") + 1
    suspect = Suspect(node_in(text), ASSIGNMENT, lines=("Hello time: 0", "Hello time: 1"))
    suspect = replace(suspect, place=Where(file=NODE, line=at))
    found = behind_symptom("run.by_hand", suspect)
    assert fix_of(found).startswith(
        f"Delete this line, and what adds to the counter in __init__ (line {at + 1})"
    )
    assert patched(found, text, tmp_path) == changed()


def test_a_base_class_of_the_package_is_a_node() -> None:
    base = "class Base(Node):\n    def __init__(self, name, start):\n        super().__init__(name)\n\n\n"
    text = changed(("class MyFirstNode(Node)", f"{base}class MyFirstNode(Base)"),
                   (IMPORT, "from my_robot_controller.base import Base\nimport rclpy\nfrom"))  # fmt: skip
    error = "TypeError: Base.__init__() missing 1 required positional argument: 'start'"
    found = raised(error, text, line_of(text, "__init__('my_first_node')"))
    assert kind_of(found) != "node.other_node_class"


def test_the_inner_function_and_the_inner_timer_are_taken_out(tmp_path: Path) -> None:
    inner = f"        def say():\n    {LOG}    {STEP}"
    text = changed((BODY, inner))
    assert patched(look("run.no_lines", text), text, tmp_path) == changed()
    text = changed((TIMER, ""), (LOG, TIMER + LOG))
    assert patched(look("run.no_lines", text), text, tmp_path) == changed()


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
    assert kind_of(look("run.no_lines", both)) == "node.log_if"


def test_a_condition_around_the_call_of_what_logs_is_named(tmp_path: Path) -> None:
    say = f"\n    def say(self):\n{LOG}"
    text = changed((START, f"{START}        self.on = False\n"),
                   (BODY, f"        if self.on:\n            self.say()\n    {STEP}{say}"))  # fmt: skip
    found = look("run.no_lines", text)
    assert kind_of(found) == "node.log_if"
    assert "the condition self.on is true" in why_of(found)
    assert "        self.say()\n        self.counter_ += 1\n" in patched(found, text, tmp_path)


def test_a_static_method_is_not_said_to_get_self() -> None:
    static = "    @staticmethod\n    def word():\n        return 'Hello time: '\n\n"
    text = changed((DEF, static + DEF), ("'Hello time: ' + ", "self.word(0) + "))
    error = "TypeError: MyFirstNode.word() takes 0 positional arguments but 1 was given"
    assert kind_of(raised(error, text, line_of(text, "self.word(0)"))) != "node.callback_no_self"


def test_a_static_callback_is_not_what_cannot_be_called() -> None:
    text = changed((DEF, f"    @staticmethod\n{DEF.replace('self', '')}"), ("str(self", "''(self"))
    error = "TypeError: 'str' object is not callable"
    assert kind_of(raised(error, text, line_of(text, "info("))) != "node.callback_decorated"


@pytest.mark.parametrize("first", ["count", "timer_callback"])
def test_the_callback_is_that_of_the_timer_that_logs(first: str) -> None:
    other = "count" if first == "timer_callback" else "timer_callback"
    timers = "".join(TIMER.replace("timer_callback", name) for name in (first, other))
    count = "    def count(self):\n        self.other_ = 1\n\n"
    text = changed(
        (TIMER, timers), (DEF, count + DEF), (LOG, f"        if self.counter_ > 3:\n    {LOG}")
    )
    found = look("run.no_lines", text)
    assert kind_of(found) == "node.log_if"
    assert kind_of(look("run.no_lines", text.replace(".info(", ".debug("))) == "node.debug_level"


def test_an_inner_function_with_a_parameter_is_to_be_called() -> None:
    inner = f"        def say(number):\n    {LOG.replace('self.counter_', 'number')}"
    found = look("run.no_lines", changed((LOG, inner)))
    assert kind_of(found) == "node.inner_not_called"
    assert fix_of(found).endswith("with a value for each of its parameters: number")


@pytest.mark.parametrize("value", ["None", "False"])
def test_a_flag_is_not_asked_for_none(value: str) -> None:
    text = changed(
        (START, f"{START}        self.on = {value}\n"), (LOG, f"        if self.on:\n    {LOG}")
    )
    source = node_in(text)
    goal = Goal("Hello time: ", "", 0, 1, 1.0)
    texts = [change.text for change in small_changes(source, goal)]
    assert any("self.on is not None" in each for each in texts) == (value == "None")


def test_a_text_that_is_made_above_the_log_shows_the_counter_too() -> None:
    base = f"class Base(Node):\n{DEF}{STEP}\n\n"
    made = (
        "        text = 'Hello time: ' + str(self.counter_)\n        self.get_logger().info(text)\n"
    )
    text = changed(("class MyFirstNode(Node)", f"{base}class MyFirstNode(Base)"), (BODY, made))
    assert kind_of(look("run.constant_counter", text)) == "node.base_replaced"


@pytest.mark.parametrize(
    "text", ["'Hello time: ' + str(self.counter_)", "f'Hello {1}' + self.counter_"]
)
def test_a_text_with_the_counter_is_no_sum_under_another_name(text: str) -> None:
    made = f"        text = {text}\n        self.get_logger().info(text)\n"
    assert kind_of(look("run.constant_counter", changed((BODY, made)))) != "node.counter_other_name"


def test_a_callback_that_is_made_and_not_returned_is_named() -> None:
    inner = f"        def say():\n    {LOG}    {STEP}"
    text = changed(("self.timer_callback)", "self.timer_callback())"), (BODY, inner))
    found = raised("TypeError: 'NoneType' object is not callable", text, None)
    assert found is not None
    assert (found.kind, found.variant) == ("node.callback_called", "not_returned")
    assert fix_of(found).startswith("Write return say as the last line of timer_callback")
    assert found.where is not None
    assert found.where.line == line_of(text, "def say")


@pytest.mark.parametrize(
    ("more", "expected"),
    [
        ("", "Delete pause with its lines"),
        ("        self.x = 1\n", "Delete the loop around this line"),
    ],
)
def test_a_loop_of_asyncio_goes_with_what_awaits_it(more: str, expected: str) -> None:
    loop = "        for i in range(2):\n            await asyncio.sleep(0.1)\n"
    pause = f"\n    async def pause(self):\n{more}{loop}"
    text = changed((IMPORT, "import asyncio\nimport rclpy\nfrom"), (DEF, f"    async {DEF.strip()}\n"),
                   (BODY, f"        await self.pause()\n{BODY}{pause}"))  # fmt: skip
    found = raised("RuntimeError: no running event loop", text, line_of(text, "asyncio.sleep"))
    assert fix_of(found).startswith(expected)
    assert f"(lines: {line_of(text, 'await self.pause')})" in fix_of(found)


def test_a_callback_that_calls_itself_under_a_condition_is_named(tmp_path: Path) -> None:
    again = "        if self.counter_ < 5:\n            self.timer_callback()\n"
    text = changed((STEP, STEP + again))
    found = look("run.twice", text)
    assert found is not None
    assert (found.kind, found.variant) == ("node.calls_itself", "timed_if")
    assert patched(found, text, tmp_path) == changed()
