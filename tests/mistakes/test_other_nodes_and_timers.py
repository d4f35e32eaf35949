"""A second node, a second timer, a timer that does not start: named with the student's words."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.package.source.time_limit import time_limit
from tests.mistakes.test_from_source import look, node_in
from tests.mistakes.test_named_exactly import LOG, STEP, changed, fix_of, patched, why_of

TIMER = "        self.create_timer(1.0, self.timer_callback)\n"
SPIN = "        rclpy.spin(node)\n"
NODE = "    node = MyFirstNode()\n"
OTHER = f"{NODE}    helper = rclpy.create_node('helper')\n"


def test_two_nodes_in_one_executor_are_no_mistake() -> None:
    both = "        executor.add_node(helper)\n        executor.add_node(node)\n"
    found = look("run.no_lines", changed((NODE, OTHER), (SPIN, f"{both}        executor.spin()\n")))
    assert found is None


@pytest.mark.parametrize(
    ("value", "why"), [("1 // 2", "period 0"), ("int(0.5)", "period 0"), ("0 * 2", "period 0")]
)
def test_a_period_that_is_calculated_as_0_is_found(value: str, why: str, tmp_path: Path) -> None:
    period = "        self.period = {}\n" + TIMER.replace("1.0", "self.period")
    text = changed((TIMER, period.format(value)))
    found = look("run.too_much_output", text)
    assert fix_of(found) == f"Write 1.0 instead of {value} in this line."
    assert why in why_of(found)
    assert patched(found, text, tmp_path) == changed((TIMER, period.format("1.0")))


def test_a_callback_that_spins_is_named_when_the_lines_stop() -> None:
    found = look("run.stops", changed((STEP, f"{STEP}        rclpy.spin_once(self)\n")))
    assert fix_of(found) == "Remove spin_once from the callback: main spins the node."


def test_a_spin_with_a_timeout_is_found() -> None:
    limited = "        rclpy.spin_until_future_complete(node, Future(), timeout_sec=10)\n"
    found = time_limit(node_in(changed((SPIN, limited))))
    assert found is not None
    assert found[1:] == ("timeout_sec=10", "rclpy.spin(node)")
    assert time_limit(node_in(changed())) is None
    looped = f"        while rclpy.ok():\n    {limited}"
    assert time_limit(node_in(changed((SPIN, looped)))) is None


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
