"""A parameter that is read as another type, and a flood that comes from the period."""

from __future__ import annotations

import pytest

from tests.mistakes.test_from_source import RIGHT, look

TIMER = "        self.create_timer(1.0,"


def with_period(default: str, field: str) -> str:
    return RIGHT.replace(
        TIMER,
        f"        self.declare_parameter('period', {default})\n"
        f"        period = self.get_parameter('period').get_parameter_value().{field}\n"
        "        self.create_timer(period,",
    )


@pytest.mark.parametrize(
    ("new", "kind", "variant"),
    [
        ("        self.create_timer(0,", "period_wrong", ""),
    ],
)
def test_a_flood_of_the_callback_comes_from_the_period(new: str, kind: str, variant: str) -> None:
    found = look("run.too_much_output", RIGHT.replace(TIMER, new))
    assert found is not None
    assert (found.kind, found.variant) == (f"node.{kind}", variant)
