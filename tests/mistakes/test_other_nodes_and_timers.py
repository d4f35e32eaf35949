"""A second node, a second timer, a timer that does not start: named with the student's words."""

from __future__ import annotations

import pytest

from tests.mistakes.test_from_source import look
from tests.mistakes.test_named_exactly import LOG, STEP, changed

TIMER = "        self.create_timer(1.0, self.timer_callback)\n"
SPIN = "        rclpy.spin(node)\n"
NODE = "    node = MyFirstNode()\n"
OTHER = f"{NODE}    helper = rclpy.create_node('helper')\n"


def test_two_nodes_in_one_executor_are_no_mistake() -> None:
    both = "        executor.add_node(helper)\n        executor.add_node(node)\n"
    found = look("run.no_lines", changed((NODE, OTHER), (SPIN, f"{both}        executor.spin()\n")))
    assert found is None


def test_a_clean_up_for_later_is_not_told_as_early() -> None:
    later = "\n    def prepare(self):\n        atexit.register(lambda: self.destroy_node())\n"
    text = changed((STEP, STEP + later), (NODE, f"{NODE}    node.prepare()\n"))
    assert look("run.no_lines", text) is None


@pytest.mark.parametrize("test", ["True", "rclpy.ok()"])
def test_a_condition_that_is_true_is_not_why_there_is_no_timer(test: str) -> None:
    assert look("run.no_lines", changed((TIMER, f"        if {test}:\n    {TIMER}"))) is None


def test_a_callback_without_a_log_comes_before_a_condition() -> None:
    edits = (TIMER, f"        if self.on:\n    {TIMER}"), (f"        {LOG}\n", "")
    found = look("run.no_lines", changed(*edits))
    assert found is not None
    assert found.kind == "node.log_missing"
