"""Nodes whose callback fails at its first call, is never called, or stops being called."""

from __future__ import annotations

from grader.validate.tree import Edit, Replace

from .model import NODE, TICKS, Package, broken
from .right_node import COUNT, LINE, STEP, TIMER

LOG = "self.get_logger().info"


def _dies(name: str, mistake: str, *edits: Edit, note: str = "") -> Package:
    """Return a package whose node ends before its first line."""
    return broken(
        name,
        *edits,
        failed={"run.output": mistake},
        skipped=TICKS | {"run.interrupt"},
        score=80,
        note=note,
    )


def _silent(name: str, mistake: str, *edits: Edit, note: str = "") -> Package:
    """Return a package whose node logs nothing until Ctrl+C."""
    return broken(name, *edits, failed={"run.output": mistake}, skipped=TICKS, score=83, note=note)


def _node(old: str, new: str) -> Edit:
    return Replace(NODE, old, new)


CALLBACK = (
    _dies("str_missing", "node.str_plus_int", _node("str(self.counter_)", "self.counter_"),
          note="can only concatenate str (not \"int\") to str"),
    _dies("callback_without_self", "node.callback_no_self",
          _node("def timer_callback(self)", "def timer_callback()")),
    _dies("callback_wants_message", "node.callback_parameter",
          _node("def timer_callback(self)", "def timer_callback(self, msg)")),
    _dies("get_logger_not_called", "node.logger_not_called", _node(LOG, "self.get_logger.info")),
    _dies("logger_misspelt", "node.method_misspelt", _node(LOG, "self.get_loger().info")),
    _dies("logger_with_comma", "node.logger_arguments",
          _node("'Hello time: ' + str", "'Hello time: ', str"),
          note="as print would take it"),
    _dies("counter_not_set", "node.attribute_not_set", _node(f"        {COUNT}\n", "")),
    _dies("counter_without_self", "node.attribute_not_set", _node(COUNT, "counter_ = 0")),
    _dies("counter_local", "node.counter_local",
          _node(LINE, LINE.replace("self.counter_", "counter_")),
          _node(STEP, "counter_ += 1")),
    _dies("counter_of_other_name", "node.attribute_not_set", _node(COUNT, "self.counter = 0")),
    _dies("name_error_in_callback", "node.name_unknown",
          _node(LINE, LINE.replace("str(", "string("))),
    _silent("timer_missing", "node.timer_missing", _node(f"        {TIMER}\n", "")),
    _silent("timer_in_callback", "node.timer_in_callback", _node(f"        {TIMER}\n", ""),
            _node(LINE, f"{TIMER}\n        {LINE}")),
    _silent("timer_cancelled", "node.timer_cancelled", _node(TIMER, f"{TIMER}.cancel()")),
    _silent("period_in_milliseconds", "node.period_milliseconds", _node("(1.0,", "(1000.0,")),
    _silent("logged_as_debug", "node.debug_level", _node(LOG, "self.get_logger().debug"),
            note="below the default level: neither on the terminal nor on /rosout"),
    _silent("log_line_forgotten", "node.log_missing", _node(f"        {LINE}\n", "")),
    _silent("callback_is_another", "node.timer_other_callback",
          _node("self.timer_callback)", "self.get_name)")),
    broken("three_then_silence",
           _node(TIMER, f"self.timer_ = {TIMER}"),
           _node(STEP, f"{STEP}\n        if self.counter_ == 3:\n            self.timer_.cancel()"),
           failed={"run.output": "node.timer_cancelled"}, score=90),
    broken("three_then_exit",
           _node(STEP, f"{STEP}\n        if self.counter_ == 3:\n            raise SystemExit"),
           failed={"run.output": "node.exits"}, skipped=frozenset({"run.interrupt"}),
           score=87),
    broken("spins_until_three", _node("rclpy.spin(node)", "while node.counter_ < 3:\n"
           "            rclpy.spin_once(node)"),
           failed={"run.output": "node.spin_once"}, skipped=frozenset({"run.interrupt"}),
           score=87),
    broken("brackets_behind_callback", _node("self.timer_callback)", "self.timer_callback())"),
           failed={"run.output": "node.callback_called", "run.period": "node.callback_called"},
           skipped=frozenset({"run.interrupt"}), score=83,
           note="one line at once, then 'NoneType' object is not callable"),
)  # fmt: skip
