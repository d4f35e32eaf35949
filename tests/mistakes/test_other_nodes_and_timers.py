"""A second node, a second timer, a timer that does not start: named with the student's words."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.package.source.time_limit import time_limit
from tests.mistakes.test_from_source import line_of, look, node_in, raised
from tests.mistakes.test_named_exactly import LOG, STEP, changed, fix_of, patched, why_of

TIMER = "        self.create_timer(1.0, self.timer_callback)\n"
KEPT = TIMER.replace("self.c", "self.timer_ = self.c")
SPIN = "        rclpy.spin(node)\n"
NODE = "    node = MyFirstNode()\n"
OTHER = f"{NODE}    helper = rclpy.create_node('helper')\n"


@pytest.mark.parametrize(
    "spin", [SPIN, SPIN.replace("rclpy.spin", "executor.add_node") + "        executor.spin()\n"]
)
def test_the_node_that_is_to_be_spun_takes_the_others_place(spin: str, tmp_path: Path) -> None:
    wrong = changed((NODE, OTHER), (SPIN, spin.replace("(node)", "(helper)")))
    found = look("run.no_lines", wrong)
    assert found is not None
    assert found.kind == "node.other_node_spun"
    assert fix_of(found) == "Write node instead of helper in this line."
    assert patched(found, wrong, tmp_path) == changed((NODE, OTHER), (SPIN, spin))


def test_two_nodes_in_one_executor_are_no_mistake() -> None:
    both = "        executor.add_node(helper)\n        executor.add_node(node)\n"
    found = look("run.no_lines", changed((NODE, OTHER), (SPIN, f"{both}        executor.spin()\n")))
    assert found is None or found.kind != "node.other_node_spun"


def test_another_timers_callback_that_does_not_return_is_named() -> None:
    work = "\n    def work(self):\n        while True:\n            pass\n"
    second = TIMER.replace("timer_callback", "work")
    text = changed((TIMER, TIMER + second), (STEP, STEP + work))
    found = look("run.stops", text)
    assert fix_of(found) == "Remove while from work: its timer does the repeating."
    assert "as long as work does not return, nothing calls timer_callback" in why_of(found)


def test_a_method_that_cleans_up_above_spin_is_named() -> None:
    stop = "\n    def stop(self):\n        self.destroy_node()\n"
    text = changed((STEP, STEP + stop), (NODE, f"{NODE}    node.stop()\n"))
    found = look("run.no_node", text)
    assert found is not None
    assert found.kind == "node.cleanup_early"
    assert found.where is not None
    assert found.where.line == line_of(text, "node.stop()")
    assert f"it calls stop (line {line_of(text, 'def stop')})" in fix_of(found)


def test_a_timer_that_does_not_start_is_told_so(tmp_path: Path) -> None:
    text = changed(("self.timer_callback)", "self.timer_callback, autostart=False)"))
    found = look("run.no_lines", text)
    assert fix_of(found).startswith("Delete autostart=False and the comma before it")
    assert patched(found, text, tmp_path) == changed()
    started = changed(
        (TIMER, KEPT.replace(")\n", ", autostart=False)\n        self.timer_.reset()\n"))
    )
    later = look("run.no_lines", started)
    assert later is None or later.kind != "node.timer_not_started"


def test_a_timer_under_a_condition_is_taken_out(tmp_path: Path) -> None:
    text = changed((TIMER, f"        if self.on:\n    {TIMER}"))
    found = look("run.no_lines", text)
    assert "only runs if self.on is true" in why_of(found)
    assert patched(found, text, tmp_path) == changed()


def test_a_timer_that_another_one_resets_is_named(tmp_path: Path) -> None:
    check = "\n    def check(self):\n        self.on = True\n        self.timer_.reset()\n"
    faster = TIMER.replace("1.0, self.timer_callback", "0.5, self.check")
    edits = (TIMER, KEPT + faster)
    text = changed(edits, (STEP, STEP + check))
    found = look("run.no_lines", text)
    assert fix_of(found) == "Delete this line."
    without = check.replace("        self.timer_.reset()\n", "")
    assert patched(found, text, tmp_path) == changed(edits, (STEP, STEP + without))


@pytest.mark.parametrize(
    ("value", "why"), [("1 // 2", "1 // 2 is 0"), ("int(0.5)", "period 0"), ("0 * 2", "period 0")]
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


def test_a_loop_that_calls_the_callback_beside_spin_once_goes() -> None:
    loop = "        while True:\n            node.timer_callback()\n            rclpy.spin_once(node)\n"
    for symptom in ("run.never_spins", "run.stops"):
        found = look(symptom, changed((SPIN, loop)))
        assert "rclpy.spin(node) instead of the whole while loop" in fix_of(found)
        assert "then main ends" not in why_of(found)


def test_a_daemon_thread_of_an_executor_is_told_with_the_executor() -> None:
    thread = "        executor = MultiThreadedExecutor()\n        executor.add_node(node)\n        Thread(target=executor.spin, daemon=True).start()\n"
    found = look("run.exits_at_once", changed((SPIN, thread)))
    assert fix_of(found) == "Call executor.spin() in main itself, without the thread."


def test_destroy_timer_is_not_told_as_cancel() -> None:
    text = changed((TIMER, KEPT), (LOG, f"{LOG}\n        self.destroy_timer(self.timer_)"))
    assert "destroy_timer() removes a timer" in why_of(look("run.stops", text))


def test_a_spin_with_a_timeout_is_found() -> None:
    limited = "        rclpy.spin_until_future_complete(node, Future(), timeout_sec=10)\n"
    found = time_limit(node_in(changed((SPIN, limited))))
    assert found is not None
    assert found[1:] == ("timeout_sec=10", "rclpy.spin(node)")
    assert time_limit(node_in(changed())) is None
    looped = f"        while rclpy.ok():\n    {limited}"
    assert time_limit(node_in(changed((SPIN, looped)))) is None


def test_a_timer_with_another_callback_that_calls_the_first_is_named() -> None:
    status = "\n    def status(self):\n        self.timer_callback()\n"
    second = TIMER.replace("timer_callback", "status")
    for timers, line in ((TIMER + second, 14), (second + TIMER, 15)):
        found = look("run.twice", changed((TIMER, timers), (STEP, STEP + status)))
        assert fix_of(found) == f"Delete this line: line {line} creates the timer."


def test_a_loop_that_spins_and_sleeps_is_replaced_by_spin() -> None:
    loop = (
        "        while rclpy.ok():\n            rclpy.spin_once(node)\n            time.sleep(2)\n"
    )
    text = changed((SPIN, loop))
    found = look("run.never_spins", text)
    line = line_of(text, "while rclpy.ok")
    wanted = f"Write rclpy.spin(node) instead of the whole while loop (line {line}-{line + 2})."
    assert fix_of(found) == wanted


@pytest.mark.parametrize("kept", ["", "thread = "])
def test_a_thread_that_spins_beside_spin_goes(kept: str) -> None:
    thread = f"{NODE}    {kept}threading.Thread(target=rclpy.spin, args=(node,))"
    thread += "\n    thread.start()\n" if kept else ".start()\n"
    text = changed((NODE, thread))
    found = raised("ValueError: generator already executing", text, None)
    other = f" and the other lines of the thread (lines: {line_of(text, 'threading.Thread') + 1})"
    spin = line_of(text, "rclpy.spin(node)")
    assert fix_of(found) == f"Delete this line{other if kept else ''}: line {spin} spins the node."


def test_what_needs_ros_below_spin_is_told_with_its_uses() -> None:
    late = "    rate = node.create_rate(1)\n    while rclpy.ok():\n        rate.sleep()\n    try:\n        pass\n"
    text = changed(("    finally:\n", f"{late}    finally:\n"))
    line = line_of(text, "create_rate")
    error = "RCLError: failed to create timer: the given context is not valid, either rcl_init()"
    found = raised(error, text, line)
    uses = f"{line + 1}-{line + 2}"
    assert fix_of(found) == f"Delete this line, and what uses its value (line {uses})."


def test_the_program_that_starts_itself_again_is_found() -> None:
    last = "        rclpy.try_shutdown()\n"
    text = changed((last, f"{last}    main()\n"))
    for found in (look("run.ignores_interrupt", text), raised("RecursionError: deep", text, 3)):
        assert found is not None
        assert found.kind == "node.starts_again"
        assert fix_of(found) == "Delete this line."


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
