"""A return above the line that logs: its condition is named if the source shows that it is true."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.mistakes.test_from_source import line_of, look
from tests.mistakes.test_named_exactly import LOG, STEP, changed, fix_of, patched, why_of

LOG_LINE = f"        {LOG}\n"
START = "        self.counter_ = 0\n"


def with_if(condition: str, more: str = "") -> str:
    return changed(
        (LOG_LINE, f"        if {condition}:\n            return\n{LOG_LINE}"),
        (START, START + more),
    )


@pytest.mark.parametrize(
    ("condition", "written", "more", "why"),
    [
        ("~rclpy.ok()", "not rclpy.ok()", "", "~True is -2"),
        ("~self.on", "not self.on", "        self.on = True\n", "~True is -2"),
        ("rclpy.ok", "not rclpy.ok()", "", "without () is the function itself"),
        ("rclpy.ok()", "not rclpy.ok()", "", "true as long as the node runs"),
    ],
)
def test_the_contrary_is_written(
    condition: str, written: str, more: str, why: str, tmp_path: Path
) -> None:
    text = with_if(condition, more)
    found = look("run.no_lines", text)
    assert fix_of(found) == f"Write {written} instead of {condition}."
    assert why in why_of(found)
    assert found is not None
    assert found.where is not None
    assert found.where.line == line_of(text, f"if {condition}")
    assert patched(found, text, tmp_path) == with_if(written, more)


@pytest.mark.parametrize(
    ("condition", "more"),
    [
        ("~self.off", "        self.off = False\n"),
        ("self.timer_callback", ""),
        ("self.timer_callback is not None", ""),
        ("self.counter_ == 3 or 4", ""),
        ("True", ""),
    ],
)
def test_an_if_that_is_always_true_is_deleted_with_its_return(
    condition: str, more: str, tmp_path: Path
) -> None:
    text = with_if(condition, more)
    found = look("run.no_lines", text)
    first = line_of(text, f"if {condition}")
    assert fix_of(found) == f"Delete line {first}-{first + 1}, the if and its return."
    assert patched(found, text, tmp_path) == changed((START, START + more))


def test_a_condition_that_the_source_does_not_decide_is_only_named(tmp_path: Path) -> None:
    text = with_if("self.limit < 1", "        self.limit = 0\n")
    found = look("run.no_lines", text)
    first = line_of(text, "if self.limit < 1")
    assert fix_of(found).startswith(f"Delete line {first}-{first + 1}, the if and its return. If")
    assert "while the condition self.limit < 1 is true" in why_of(found)
    assert not patched(found, text, tmp_path)


@pytest.mark.parametrize(
    "condition", ["self.counter_ > 3", "self.counter_ == 10", "5 <= self.counter_"]
)
def test_a_limit_of_the_count_is_deleted(condition: str, tmp_path: Path) -> None:
    text = with_if(condition)
    found = look("run.stops", text)
    first = line_of(text, f"if {condition}")
    assert fix_of(found) == f"Delete line {first}-{first + 1}, the if and its return."
    assert patched(found, text, tmp_path) == changed()


@pytest.mark.parametrize("condition", ["self.limit", "self.counter_ > self.limit", "not self.on"])
def test_another_condition_is_no_limit_of_the_count(condition: str) -> None:
    found = look("run.stops", with_if(condition))
    assert found is None or found.kind != "node.return_early"


@pytest.mark.parametrize(
    ("lines", "fix"),
    [
        ("if self.counter_ < 1:\n            print()\n            return", "Remove that return"),
        (
            "try:\n            x = self.counter_\n        except ValueError:\n            return",
            "pass",
        ),
        (
            "if self.counter_ < 1:\n            return\n        else:\n            pass",
            "Correct the",
        ),
    ],
)
def test_no_block_is_left_without_a_line(lines: str, fix: str) -> None:
    found = look("run.no_lines", changed((LOG_LINE, f"        {lines}\n{LOG_LINE}")))
    assert fix in fix_of(found)


@pytest.mark.parametrize(
    "condition",
    ["not rclpy.ok()", "not rclpy.ok", "not self.timer_callback", "False", "None and True"],
)
def test_a_return_that_is_never_reached_is_not_the_cause(condition: str) -> None:
    found = look("run.no_lines", with_if(condition))
    assert found is None or found.kind != "node.return_early"


def test_a_return_of_a_function_in_the_callback_is_its_own() -> None:
    inner = "        def text():\n            return str(self.counter_)\n"
    found = look("run.no_lines", changed((STEP, STEP), (LOG_LINE, inner + LOG_LINE)))
    assert found is None or found.kind != "node.return_early"
