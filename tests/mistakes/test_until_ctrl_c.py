"""What runs until Ctrl+C and what only after it: timers that are stopped, lines that wait."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.mistakes.test_from_source import line_of, look
from tests.mistakes.test_named_exactly import LOG, STEP, changed, fix_of, patched, why_of

TIMER = "        self.create_timer(1.0, self.timer_callback)\n"
KEPT = (TIMER, TIMER.replace("self.c", "self.timer_ = self.c"))
CLOSE = (
    STEP,
    f"{STEP}\n    def close(self):\n        self.timer_.cancel()\n        self.destroy_node()\n",
)
NO_LOG = (f"        {LOG}\n", "")
AT_END = ("        node.destroy_node()\n", "        node.close()\n")
LAST = "        rclpy.try_shutdown()\n"
MAIN = "def main(args=None)"


def test_a_timer_that_is_stopped_at_the_end_is_not_why_no_line_comes() -> None:
    found = look("run.no_lines", changed(KEPT, CLOSE, NO_LOG, AT_END))
    assert found is not None
    assert found.kind == "node.log_missing"


@pytest.mark.parametrize(
    "edit",
    [
        ("    try:\n", "    node.timer_.cancel()\n    try:\n"),
        (KEPT[1], f"{KEPT[1]}        self.timer_.cancel()\n"),
        (KEPT[1], f"{KEPT[1]}        if True:\n            self.timer_.cancel()\n"),
    ],
)
def test_a_timer_that_is_stopped_before_spin_is_why(edit: tuple[str, str], tmp_path: Path) -> None:
    text = changed(KEPT, edit)
    found = look("run.no_lines", text)
    assert found is not None
    assert found.kind == "node.timer_cancelled"
    assert found.where is not None
    assert found.where.line == line_of(text, "timer_.cancel()")
    above = " and the if above it" if "if True" in edit[1] else ""
    assert fix_of(found) == f"Delete this line{above}."
    assert patched(found, text, tmp_path) == changed(KEPT)


def test_a_callback_that_stops_its_timer_and_does_not_log_lacks_the_log() -> None:
    text = changed(KEPT, NO_LOG, (STEP, "        self.timer_.cancel()\n"))
    found = look("run.no_lines", text)
    assert found is not None
    assert found.kind == "node.log_missing"


@pytest.mark.parametrize(
    ("waits", "fix"),
    [
        ("        input('Press Enter')\n", "Delete this line."),
        ("    time.sleep(60)\n", "Delete this line."),
        ("    while True:\n        time.sleep(1)\n", "Delete the whole while (line 33-34)."),
    ],
)
def test_the_line_that_waits_below_spin_is_named(waits: str, fix: str, tmp_path: Path) -> None:
    text = changed((LAST, LAST + waits))
    found = look("run.ignores_interrupt", text)
    assert found is not None
    assert found.kind == "node.waits_at_end"
    assert found.where is not None
    assert found.where.line == line_of(text, waits.splitlines()[0])
    assert fix_of(found) == fix
    assert patched(found, text, tmp_path) == changed()


def test_the_line_that_waits_in_an_except_is_replaced() -> None:
    text = changed(("        pass\n", "        input('Really? ')\n"))
    assert fix_of(look("run.ignores_interrupt", text)) == "Write pass instead of this line."


def test_a_question_whose_answer_is_used_is_told_with_its_uses() -> None:
    asks = "    answer = input('Close? ')\n    print(answer)\n"
    text = changed((LAST, LAST + asks))
    line = line_of(text, "print(answer)")
    found = look("run.ignores_interrupt", text)
    assert fix_of(found) == f"Delete this line, and what uses its value (line {line})."


def test_a_function_that_waits_below_spin_is_looked_into() -> None:
    asks = "def ask():\n    while input('Close? ') != 'y':\n        pass\n\n\n"
    text = changed((MAIN, asks + MAIN), (LAST, f"{LAST}    ask()\n"))
    found = look("run.ignores_interrupt", text)
    assert found is not None
    assert found.kind == "node.waits_at_end"
    line = line_of(text, "while input")
    assert fix_of(found) == f"Write pass instead of the whole while (line {line}-{line + 1})."
    assert f"the while (line {line}-{line + 1}) waits" in why_of(found)


@pytest.mark.parametrize("edit", [(LAST, f"{LAST}        time.sleep(0.5)\n"), (LAST, LAST)])
def test_a_short_sleep_below_spin_keeps_nothing_running(edit: tuple[str, str]) -> None:
    assert look("run.ignores_interrupt", changed(edit)) is None


@pytest.mark.parametrize("timer", ["partial(greet, self)", "lambda: greet(self)"])
def test_a_function_of_the_file_that_does_not_log_is_named(timer: str) -> None:
    greet = "def greet(node):\n    node.counter_ += 1\n\n\nclass MyFirstNode"
    rest = (f"        {LOG}\n{STEP}", "        pass\n")
    text = changed(("class MyFirstNode", greet), ("self.timer_callback)", f"{timer})"), rest)
    found = look("run.no_lines", text)
    if "partial" in timer:
        assert fix_of(found) == "Write node.get_logger().info(…) in greet."
    assert found is None or found.kind == "node.log_missing"


def test_a_lambda_that_only_returns_the_text_gets_the_call() -> None:
    value = "'Hello time: %i' % next(self.numbers)"
    text = changed(
        ("self.timer_callback)", f"lambda: {value})"),
        (LOG, "pass"),
    )
    text = text.replace("    def timer_callback", "    def other")
    found = look("run.no_lines", text)
    assert fix_of(found) == f"Write self.get_logger().info({value}) instead of {value}."


def test_a_callback_that_calls_what_logs_is_not_told_to_log() -> None:
    say = f"\n    def say(self):\n        {LOG}\n"
    text = changed((LOG, "if self.counter_ > 99: self.say()"), (STEP, STEP + say))
    found = look("run.no_lines", text)
    assert found is None or found.kind != "node.log_missing"


SECOND = TIMER.replace("self.c", "self.second = self.c")
START = f"\n    def start(self):\n        self.flag = True\n{TIMER}"


@pytest.mark.parametrize(
    ("edits", "at", "fix"),
    [
        ([(TIMER, TIMER + SECOND)], "self.second", "Delete this line: line 14 creates the timer."),
        (
            [(TIMER, TIMER.replace("1.0", "0.5") + TIMER)],
            "create_timer(0.5",
            "Delete this line: line 15 creates the timer.",
        ),
        (
            [(TIMER, f"        for i in range(2):\n    {TIMER}")],
            "create_timer",
            "Create the timer only once, without the for of line 14.",
        ),
        (
            [
                (TIMER, "        self.start()\n"),
                (STEP, STEP + START),
                ("    try:\n", "    node.start()\n    try:\n"),
            ],
            "node.start()",
            "Delete this line: line 14 calls start.",
        ),
    ],
)
def test_the_timer_that_is_too_many_is_named(
    edits: list[tuple[str, str]], at: str, fix: str
) -> None:
    text = changed(*edits)
    found = look("run.twice", text)
    assert found is not None
    assert found.kind == "node.two_timers"
    assert found.where is not None
    assert found.where.line == line_of(text, at)
    assert fix_of(found) == fix


def test_a_timer_of_a_silent_callback_is_not_why_two_lines_come() -> None:
    other = "\n    def blink(self):\n        self.on = True\n"
    blinks = TIMER.replace("timer_callback", "blink")
    text = changed((TIMER, TIMER + blinks), (STEP, STEP + other), (LOG, f"{LOG}\n        {LOG}"))
    found = look("run.twice", text)
    assert found is None or found.kind != "node.two_timers"


@pytest.mark.parametrize("first", [TIMER, "        self.start()\n"])
def test_a_method_that_creates_the_timer_again_is_named(first: str) -> None:
    text = changed((TIMER, first), (STEP, f"{STEP}        self.start()\n{START}"))
    found = look("run.wrong_period", text)
    assert found is not None
    assert found.kind == "node.timer_again"
    fix = fix_of(found)
    assert "This line calls start" in fix
    assert f"line {len(text[: text.rindex('self.create_timer')].splitlines())}" in fix


@pytest.mark.parametrize(
    ("first", "method"),
    [
        ("signal.signal(signal.SIGINT, self.stop)", "self.timer_.cancel()"),
        ("self.context.on_shutdown(self.stop)", "self.timer_.cancel()"),
        ("self.stop()", f"self.timer_.cancel()\n{KEPT[1].rstrip()}"),
    ],
)
def test_a_timer_that_is_stopped_later_or_made_anew_is_not_why(first: str, method: str) -> None:
    stop = f"\n    def stop(self, *other):\n        {method}\n"
    text = changed((TIMER, f"{KEPT[1]}        {first}\n"), (STEP, STEP + stop))
    found = look("run.no_lines", text)
    assert found is None or found.kind != "node.timer_cancelled"


@pytest.mark.parametrize("waits", ["threading.Event().wait()", "signal.pause()"])
def test_what_waits_for_ever_below_spin_is_named(waits: str) -> None:
    found = look("run.ignores_interrupt", changed((LAST, f"{LAST}    {waits}\n")))
    assert found is not None
    assert found.kind == "node.waits_at_end"


def test_a_method_that_a_lambda_calls_is_told_to_log() -> None:
    found = look(
        "run.no_lines",
        changed(("self.timer_callback)", "lambda: self.timer_callback())"), (LOG, "pass")),
    )
    assert found is not None
    assert found.kind == "node.log_missing"
