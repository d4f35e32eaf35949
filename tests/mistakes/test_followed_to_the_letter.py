"""A fix that is carried out to the letter leads to the right code."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.mistakes.recognise import behind_symptom
from grader.mistakes.recognised import Suspect
from tests.marking import ASSIGNMENT
from tests.mistakes.test_from_source import line_of, look, node_in, raised
from tests.mistakes.test_named_exactly import changed, fix_of, patched

SPIN = "        rclpy.spin(node)\n"


@pytest.mark.parametrize(
    ("loop", "right"),
    [
        ("while not rclpy.is_shutdown():", "while rclpy.ok():"),
        ("if rclpy.is_shutdown():", "if not rclpy.ok():"),
    ],
)
def test_is_shutdown_of_ros_1_is_the_contrary_of_ok(loop: str, right: str, tmp_path: Path) -> None:
    text = changed((SPIN, f"        {loop}\n            rclpy.spin_once(node)\n"))
    error = "AttributeError: module 'rclpy' has no attribute 'is_shutdown'"
    found = raised(error, text, line=line_of(text, "is_shutdown"))
    old, new = loop.split(" ", 1)[1].rstrip(":"), right.split(" ", 1)[1].rstrip(":")
    assert fix_of(found) == f"Write {new} instead of {old}."
    assert patched(found, text, tmp_path) == text.replace(loop, right)


def test_a_step_that_is_a_float_by_name_changes_with_the_start(tmp_path: Path) -> None:
    text = changed(
        ("self.counter_ = 0", "self.period = 1.0\n        self.counter_ = 0.0"),
        ("self.counter_ += 1", "self.counter_ += self.period"),
    )
    found = behind_symptom(
        "run.wrong_text", Suspect(node_in(text), ASSIGNMENT, text="Hello time: 0.0")
    )
    assert "self.counter_ += 1 instead of self.counter_ += self.period" in fix_of(found)
    right = changed(("self.counter_ = 0", "self.period = 1.0\n        self.counter_ = 0"))
    assert patched(found, text, tmp_path) == right


def test_continue_after_ctrl_c_becomes_break(tmp_path: Path) -> None:
    try_spin = (
        "    while True:\n        try:\n            rclpy.spin(node)\n"
        "        except KeyboardInterrupt:\n            continue\n"
    )
    whole = changed()
    start, end = whole.index("    try:\n"), whole.index("\n\nif __name__")
    text = whole[:start] + try_spin + whole[end:]
    found = look("run.ignores_interrupt", text)
    assert f"Write break instead of continue on line {line_of(text, 'continue')}" in fix_of(found)
    assert patched(found, text, tmp_path) == text.replace("continue", "break")
