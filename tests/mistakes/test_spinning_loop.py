"""A loop around spin_once: what to write instead depends on what else it does."""

from __future__ import annotations

import pytest

from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.recognise import behind_symptom
from grader.mistakes.recognised import Suspect
from tests.marking import ASSIGNMENT
from tests.mistakes.other_forms import RIGHT, TIMER, changed
from tests.mistakes.test_period_origin import source_in

SPIN = "        rclpy.spin(node)\n"
NO_TIMER = (f"        {TIMER}\n", "")


def told(text: str, symptom: str = "run.never_spins") -> tuple[str, str]:
    """Return the reason and the fix."""
    found = behind_symptom(symptom, Suspect(source_in(text), ASSIGNMENT))
    assert found is not None
    assert found.kind in ("node.spin_once", "node.spin_loop_ends")
    kind, words = CATALOGUE[found.kind], {**found.params, **found.words}
    return str(kind.rationale(words, found.variant)), str(kind.fix_text(words, found.variant))


def looped(head: str, *lines: str) -> tuple[str, str]:
    body = "".join(f"            {line}\n" for line in lines)
    return SPIN, f"        {head}:\n{body}"


@pytest.mark.parametrize("symptom", ["run.never_spins", "run.ended_early"])
def test_a_loop_that_calls_the_method_gets_a_timer(symptom: str) -> None:
    lines = ("node.timer_callback()", "rclpy.spin_once(node, timeout_sec=1.0)")
    _, fix = told(changed(RIGHT, NO_TIMER, looped("while rclpy.ok()", *lines)), symptom)
    assert "first node.create_timer(1.0, node.timer_callback)" in fix
    assert fix.endswith("below it rclpy.spin(node).")


def test_a_loop_that_logs_itself_gets_a_method() -> None:
    lines = ("node.get_logger().info('a')", "n += 1", "rclpy.spin_once(node)")
    _, fix = told(changed(RIGHT, NO_TIMER, looped("while rclpy.ok()", *lines)))
    assert "def tick(self):" in fix
    assert "node.create_timer(1.0, node.tick)" in fix


def test_with_a_timer_spin_is_enough() -> None:
    text = changed(RIGHT, looped("for _ in range(5)", "rclpy.spin_once(node)"))
    _, fix = told(text, "run.ended_early")
    assert fix == "Write rclpy.spin(node) instead of the whole for loop around this line."


@pytest.mark.parametrize(
    ("head", "lines", "is_named"),
    [
        ("while node.counter_ < 5", (), True),
        ("while not rclpy.ok()", (), True),
        ("while rclpy.ok()", (), False),
        ("while node.counter_ < 5", ("if node.counter_ > 3:", "    break"), False),
    ],
)
def test_the_condition_is_named_if_it_alone_ends_the_loop(
    head: str, lines: tuple[str, ...], is_named: bool
) -> None:
    text = changed(RIGHT, looped(head, "rclpy.spin_once(node)", *lines))
    reason, _ = told(text, "run.ended_early")
    assert (head.removeprefix("while ") in reason) is is_named
