"""A parameter that is read as another type, and a flood that comes from the period."""

from __future__ import annotations

import pytest

from tests.mistakes.test_from_source import RIGHT, line_of, look

TIMER = "        self.create_timer(1.0,"


def with_period(default: str, field: str) -> str:
    return RIGHT.replace(
        TIMER,
        f"        self.declare_parameter('period', {default})\n"
        f"        period = self.get_parameter('period').get_parameter_value().{field}\n"
        "        self.create_timer(period,",
    )


@pytest.mark.parametrize(
    ("default", "field", "name", "written", "at"),
    [
        ("1", "double_value", "1", "1.0", "declare"),
        ("1.0", "integer_value", "integer_value", "double_value", "get_parameter_value"),
        ("'1.0'", "double_value", "'1.0'", "1.0", "declare"),
    ],
)
def test_the_type_of_a_parameter_is_compared(
    default: str, field: str, name: str, written: str, at: str
) -> None:
    text = with_period(default, field)
    found = look("run.too_much_output", text)
    assert found is not None
    assert found.kind == "node.parameter_field"
    assert (found.params["name"], found.params["written"]) == (name, written)
    assert found.where is not None
    assert found.where.line == line_of(text, at)


@pytest.mark.parametrize(("default", "field"), [("1.0", "double_value"), ("2", "integer_value")])
def test_a_parameter_of_the_right_type_is_not_told(default: str, field: str) -> None:
    found = look("run.wrong_period", with_period(default, field))
    assert found is None or found.kind != "node.parameter_field"


@pytest.mark.parametrize(
    ("new", "kind", "variant"),
    [
        ("        self.create_timer(1e-9,", "period_tiny", ""),
        ("        self.create_timer(1.0 / 1e6,", "period_tiny", ""),
        ("        self.create_timer(self.seconds(),", "period_tiny", "unknown"),
        ("        self.create_timer(0,", "period_zero", ""),
    ],
)
def test_a_flood_of_the_callback_comes_from_the_period(new: str, kind: str, variant: str) -> None:
    found = look("run.too_much_output", RIGHT.replace(TIMER, new))
    assert found is not None
    assert (found.kind, found.variant) == (f"node.{kind}", variant)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("        self.counter_ += 1", "        while True:\n            self.counter_ += 1"),
        ("    rclpy.init", "    print('x')\n    rclpy.init"),
        (TIMER, TIMER),
    ],
)
def test_another_cause_of_a_flood_is_not_told_as_the_period(old: str, new: str) -> None:
    found = look("run.too_much_output", RIGHT.replace(old, new))
    assert found is None or found.kind != "node.period_tiny"
