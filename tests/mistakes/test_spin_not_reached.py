"""The line that spins is there, but the program does not come to it."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.mistakes.test_from_source import line_of, look
from tests.mistakes.test_named_exactly import changed, fix_of, patched, why_of

MADE, SPIN = "    node = MyFirstNode()\n", "        rclpy.spin(node)\n"
TRY = f"{MADE}    try:\n{SPIN}    except KeyboardInterrupt:\n        pass\n"
KIND = "node.spin_not_reached"


def in_except(more: str) -> str:
    tried = f"    try:\n    {MADE}    except KeyboardInterrupt:\n{SPIN}{more}"
    return changed((TRY, tried))


def test_a_spin_in_an_except_belongs_into_the_try(tmp_path: Path) -> None:
    text = in_except("")
    found = look("run.exits_at_once", text)
    line = line_of(text, "node = MyFirstNode()")
    fix = f"Move this line into the try, below line {line}, and write pass here in its place."
    assert fix_of(found) == fix
    tried = f"    try:\n    {MADE}{SPIN}    except KeyboardInterrupt:\n        pass\n"
    assert patched(found, text, tmp_path) == changed((TRY, tried))


def test_an_except_with_other_lines_keeps_them(tmp_path: Path) -> None:
    text = in_except("        print('bye')\n")
    found = look("run.exits_at_once", text)
    assert fix_of(found).endswith(f"below line {line_of(text, 'node = MyFirstNode()')}.")
    tried = f"    try:\n    {MADE}{SPIN}    except KeyboardInterrupt:\n        print('bye')\n"
    assert patched(found, text, tmp_path) == changed((TRY, tried))


@pytest.mark.parametrize(
    ("condition", "why"),
    [
        ("if __name__ == '__main__':", "__name__ is not '__main__'"),
        ("if args:", "so that args is None"),
        ("if args is not None:", "so that args is None"),
        ("if not rclpy.ok():", "below the condition not rclpy.ok()"),
        ("while not rclpy.ok():", "below the condition not rclpy.ok()"),
        ("if False:", "below the condition False"),
    ],
)
def test_a_spin_under_a_condition_that_is_false(condition: str, why: str, tmp_path: Path) -> None:
    text = changed((SPIN, f"        {condition}\n    {SPIN}"))
    found = look("run.exits_at_once", text)
    word = condition.split(maxsplit=1)[0]
    assert why in why_of(found)
    assert fix_of(found).startswith(f"Delete the line of this {word}, and indent its lines")
    assert patched(found, text, tmp_path) == changed()


def test_a_spin_in_the_else_of_a_condition_that_is_true() -> None:
    text = changed((SPIN, f"        if rclpy.ok():\n            pass\n        else:\n    {SPIN}"))
    found = look("run.exits_at_once", text)
    assert fix_of(found).startswith(f"Write rclpy.spin(node) below line {line_of(text, 'spin(')}")


@pytest.mark.parametrize("end", ["exit()", "sys.exit(0)", "raise SystemExit"])
def test_a_spin_below_what_ends_the_program(end: str, tmp_path: Path) -> None:
    text = changed((MADE, f"{MADE}    {end}\n"))
    found = look("run.exits_at_once", text)
    assert f"so that line {line_of(text, 'rclpy.spin')}" in why_of(found)
    assert patched(found, text, tmp_path) == changed()


@pytest.mark.parametrize(
    ("head", "written"),
    [("def run(node):", "run(node)"), ("def run():", "run()")],
)
def test_a_spin_in_a_function_that_nothing_calls(head: str, written: str) -> None:
    function = f"{head}\n    rclpy.spin(node)\n\n\ndef main("
    found = look("run.exits_at_once", changed((SPIN, "        pass\n"), ("def main(", function)))
    assert fix_of(found) == f"Write {written} in main, after creating the node."


def test_a_spin_in_a_method_that_nothing_calls() -> None:
    method = "    def spin(self):\n        rclpy.spin(self)\n\n    def timer_callback"
    text = changed((SPIN, "        pass\n"), ("    def timer_callback", method))
    found = look("run.exits_at_once", text)
    assert fix_of(found) == "Write node.spin() in main, after creating the node."


@pytest.mark.parametrize(
    "lines",
    [
        SPIN,
        f"        if rclpy.ok():\n    {SPIN}",
        f"        if args is None:\n    {SPIN}",
        f"        while rclpy.ok():\n    {SPIN}",
        f"        if node.counter_ > 0:\n    {SPIN}",
        f"        try:\n            pass\n        finally:\n    {SPIN}",
        f"        try:\n            pass\n        except ValueError:\n    {SPIN}",
        f"        try:\n            exit()\n        finally:\n    {SPIN}",
        f"        if not rclpy.ok():\n    {SPIN}{SPIN}",
        "        run(node)\n",
    ],
)
def test_a_spin_that_may_be_reached_is_not_the_cause(lines: str) -> None:
    function = "def run(node):\n    rclpy.spin(node)\n\n\ndef main("
    text = changed((SPIN, lines), ("def main(", function if "run(" in lines else "def main("))
    found = look("run.exits_at_once", text)
    assert found is None or found.kind != KIND
