"""What runs until Ctrl+C and what only after it: timers that are stopped, lines that wait."""

from __future__ import annotations

import pytest

from tests.mistakes.test_from_source import look
from tests.mistakes.test_named_exactly import LOG, STEP, changed

TIMER = "        self.create_timer(1.0, self.timer_callback)\n"
KEPT = (TIMER, TIMER.replace("self.c", "self.timer_ = self.c"))
CLOSE = (
    STEP,
    f"{STEP}\n    def close(self):\n        self.timer_.cancel()\n        self.destroy_node()\n",
)
NO_LOG = (f"        {LOG}\n", "")
AT_END = ("        node.destroy_node()\n", "        node.close()\n")
LAST = "        rclpy.try_shutdown()\n"


def test_a_timer_that_is_stopped_at_the_end_is_not_why_no_line_comes() -> None:
    found = look("run.no_lines", changed(KEPT, CLOSE, NO_LOG, AT_END))
    assert found is not None
    assert found.kind == "node.log_missing"


def test_a_callback_that_stops_its_timer_and_does_not_log_lacks_the_log() -> None:
    text = changed(KEPT, NO_LOG, (STEP, "        self.timer_.cancel()\n"))
    found = look("run.no_lines", text)
    assert found is not None
    assert found.kind == "node.log_missing"


@pytest.mark.parametrize("edit", [(LAST, f"{LAST}        time.sleep(0.5)\n"), (LAST, LAST)])
def test_a_short_sleep_below_spin_keeps_nothing_running(edit: tuple[str, str]) -> None:
    assert look("run.ignores_interrupt", changed(edit)) is None


def test_a_callback_that_calls_what_logs_is_not_told_to_log() -> None:
    say = f"\n    def say(self):\n        {LOG}\n"
    text = changed((LOG, "if self.counter_ > 99: self.say()"), (STEP, STEP + say))
    found = look("run.no_lines", text)
    assert found is None or found.kind != "node.log_missing"
