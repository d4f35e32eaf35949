"""The update rule of the world turtlesim, against an integration that shares no code with it."""

from __future__ import annotations

import cmath
import math
import random
from collections.abc import Sequence

import pytest

from grader.run.in_probe.turtlesim import SIZE, STEP, Field, within_pi

Command = tuple[int, float, float]  # when (ns), m/s, rad/s
MOST = 499 / 45


def driven(commands: Sequence[Command], until: int) -> tuple[float, float, float]:
    """Return x, y and theta of turtle1 in our world."""
    field = Field()
    for at, forward, turning in commands:
        field.advance(at, lambda: None, lambda _: None)
        field.turtles["turtle1"].command(forward, 0.0, turning, at)
    field.advance(until, lambda: None, lambda _: None)
    turtle = field.turtles["turtle1"]
    return turtle.x, turtle.y, turtle.theta


def summed(commands: Sequence[Command], until: int) -> tuple[float, float, float]:
    """Return the same from the rule as it is written down: a sum of complex numbers."""
    place, heading = complex(MOST / 2, MOST / 2), cmath.rect(1, 0)
    waiting = list(commands)
    since, forward, turning = 0, 0.0, 0.0
    for n in range(1, until // 16_000_000 + 1):
        now = n * 16_000_000
        while waiting and waiting[0][0] < now:
            since, forward, turning = waiting.pop(0)
        if now - since > 1_000_000_000:
            forward = turning = 0.0
        heading *= cmath.rect(1, turning * 0.016)
        place += heading * forward * 0.016
        place = complex(min(max(place.real, 0), MOST), min(max(place.imag, 0), MOST))
    return place.real, place.imag, cmath.phase(heading)


def test_a_circle_of_ten_seconds_is_that_of_the_rule_and_not_the_ideal_one() -> None:
    commands = [(k * 500_000_000, 2.0, 1.0) for k in range(20)]
    x, y, theta = driven(commands, 10_000_000_000)
    wanted = summed(commands, 10_000_000_000)
    assert (x, y) == pytest.approx(wanted[:2], abs=1e-9)
    assert within_pi(theta - wanted[2]) == pytest.approx(0, abs=1e-9)
    ideal = complex(MOST / 2, MOST / 2) + 2 * (cmath.rect(1, 10 - math.pi / 2) + 1j)
    assert 0.02 < abs(complex(x, y) - ideal) < 0.05


@pytest.mark.parametrize("seed", range(10))
def test_random_commands_lead_where_the_rule_says(seed: int) -> None:
    chance = random.Random(seed)
    for _ in range(100):
        at, commands = 0, []
        for _ in range(chance.randrange(1, 12)):
            at += chance.randrange(1_000_000, 1_600_000_000)
            commands.append((at, chance.uniform(-4, 4), chance.uniform(-4, 4)))
        until = at + chance.randrange(0, 2_000_000_000)
        found, wanted = driven(commands, until), summed(commands, until)
        assert found[:2] == pytest.approx(wanted[:2], abs=1e-6)
        assert within_pi(found[2] - wanted[2]) == pytest.approx(0, abs=1e-6)


def test_a_command_is_over_after_a_second() -> None:
    x, y, theta = driven([(0, 1.0, 0.0)], 5_000_000_000)
    assert x - MOST / 2 == pytest.approx(62 * 0.016)  # the steps until 0.992 s
    assert (y, theta) == pytest.approx((MOST / 2, 0.0))


def test_the_wall_stops_a_turtle_with_a_warning_of_both_coordinates() -> None:
    field = Field()
    said: list[str] = []
    for k in range(20):
        field.turtles["turtle1"].command(2.0, 0.0, 0.0, k * 500_000_000)
        field.advance((k + 1) * 500_000_000, lambda: None, said.append)
    turtle = field.turtles["turtle1"]
    assert (turtle.x, turtle.y) == (SIZE, SIZE / 2)
    assert turtle.hits == len(said) > 0
    assert said[0].startswith("Oh no! I hit the wall! (Clamping from [x=11.")
    assert "y=5.544444]" in said[0]


def test_a_turtle_turns_to_an_angle_on_the_shorter_way() -> None:
    field = Field()
    turtle = field.turtles["turtle1"]
    turtle.theta, turtle.goal = 3.0, -3.0
    field.advance(10 * STEP, lambda: None, lambda _: None)
    assert turtle.turning == 1.0
    assert turtle.theta == pytest.approx(within_pi(3.0 + 10 * 0.016))
    field.advance(100 * STEP, lambda: None, lambda _: None)
    assert abs(within_pi(turtle.theta - -3.0)) < 0.02
    assert turtle.turning == 0.0


def test_turtles_get_names_that_are_free() -> None:
    field = Field()
    assert field.spawn("turtle2", 1, 1, 0)
    assert field.new_name() == "turtle3"
    assert not field.spawn("turtle2", 3, 3, 0)
    assert set(field.turtles) == {"turtle1", "turtle2"}
