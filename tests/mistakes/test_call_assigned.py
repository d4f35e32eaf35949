"""A call that is written as an assignment, and assignments that are right."""

from __future__ import annotations

import pytest

from tests.mistakes.test_from_source import RIGHT, line_of, look, raised

TIMER = "self.create_timer(1.0, self.timer_callback)"


@pytest.mark.parametrize(
    ("symptom", "old", "new", "written", "variant"),
    [
        ("run.no_lines", TIMER, "self.create_timer = (1.0, self.timer_callback)", TIMER, ""),
        ("run.no_lines", TIMER, "self.create_timer = 1.0, self.timer_callback", TIMER, ""),
        ("run.no_lines", TIMER, "self.create_timer: (1.0, self.timer_callback)", TIMER, "colon"),
        ("run.no_lines", TIMER, "self.timer = (1, self.timer_callback)",
         "self.timer = self.create_timer(1, self.timer_callback)", "call"),
        ("run.exits_at_once", "rclpy.spin(node)", "rclpy.spin = node", "rclpy.spin(node)", ""),
    ],
)  # fmt: skip
def test_the_call_is_shown(symptom: str, old: str, new: str, written: str, variant: str) -> None:
    text = RIGHT.replace(old, new)
    found = look(symptom, text)
    assert found is not None
    assert (found.kind, found.variant) == ("node.call_assigned", variant)
    assert found.params["written"] == written
    assert found.where is not None
    assert found.where.line == line_of(text, new)


def test_a_value_for_the_init_of_super_is_its_argument() -> None:
    text = RIGHT.replace("__init__('my_first_node')", "__init__ = 'my_first_node'")
    error = "AttributeError: 'super' object attribute '__init__' is read-only"
    found = raised(error, text, line_of(text, "super()"))
    assert found is not None
    assert found.params["written"] == "super().__init__('my_first_node')"


@pytest.mark.parametrize(
    "new",
    [
        f"self.create_timer = self.get_logger\n        {TIMER}",
        f"self.pair_ = (1.0, self.timer_callback)\n        {TIMER}",
        f"self.create_timer: object\n        {TIMER}",
    ],
)
def test_other_assignments_are_not_taken_for_a_call(new: str) -> None:
    found = look("run.no_lines", RIGHT.replace(TIMER, new))
    assert found is None or found.kind != "node.call_assigned"
