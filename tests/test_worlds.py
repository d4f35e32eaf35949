"""What the documentation and the loader say of the worlds is what the worlds are."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.base.errors import AssignmentError
from grader.cli.update_checks_page import page
from grader.course.assignment import CheckUse
from grader.course.load import load_assignment
from grader.course.worlds import WORLDS
from grader.run.in_probe import robot, turtlesim
from grader.verdict.checks.all import CHECKS
from grader.verdict.checks.world import Happens
from tests.test_robot_world import ASSIGNMENT


def test_size_and_start_are_those_of_the_worlds() -> None:
    turtle, drive = turtlesim.Field().turtles["turtle1"], robot.Drive()
    assert WORLDS["turtlesim"].size == turtlesim.SIZE
    assert WORLDS["turtlesim"].start == (turtle.x, turtle.y, turtle.theta)
    assert WORLDS["robot"].size == robot.SIZE
    assert WORLDS["robot"].start == (drive.x, drive.y, drive.theta)
    assert WORLDS["robot"].first == robot.World.NAME


def test_the_page_has_every_name_event_and_start_of_the_worlds() -> None:
    text = page()
    for name, world in WORLDS.items():
        own = text.split(f"### World `{name}`")[1].split("\n### ")[0]
        assert f"`{world.first}`" in own
        for offer in world.offers:
            assert f"| `{offer.name}` | `{offer.type}` |" in own
        for event in world.events:
            assert f"| `{event}` |" in own


def test_a_turtle_bumps_once_each_time_that_it_reaches_the_wall() -> None:
    field, bumps = turtlesim.Field(), []
    turtle = field.turtles["turtle1"]
    for n in range(1, 400):
        turtle.command(2.0, 0.0, 3.0 if n > 300 else 0.0, n * turtlesim.STEP)
        field.advance(n * turtlesim.STEP, lambda: bumps.append(turtle.bumps), lambda _: None)
    assert sum(bumps) == 1
    assert bumps.index(True) == 173  # of 0.032 m each, from the middle: 5.544 m


def _load(folder: Path, old: str, new: str) -> dict[str, CheckUse]:
    assert ASSIGNMENT.count(old) == 1
    file = folder / "assignment.yaml"
    file.write_text(ASSIGNMENT.replace(old, new), encoding="utf-8")
    return {use.id: use for use in load_assignment(file, known_checks=CHECKS).checks}


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("    world: robot\n", "", "'world.stays' needs a world, the run 'drives' has none"),
        ("event: bump", "event: pen", "the world 'robot' has no event 'pen'"),
        ("event: bump", "event: bmp", "bump"),
        ("event: bump", "event: bump, at_least: 3, at_most: 2", "at_least is 3, above at_most"),
    ],
)
def test_what_a_world_does_not_have_is_told(old: str, new: str, words: str, tmp_path: Path) -> None:
    if old.startswith("    world"):  # (else the stimulus is told first)
        new = "    do: []\n"
        old = ASSIGNMENT[ASSIGNMENT.index(old) : ASSIGNMENT.index("checks:")]
        new = "    start: [{node: halt}]\n    clock: {period: 0.5, ticks: 16}\n"
    with pytest.raises(AssignmentError, match=r"assignment\.yaml:") as caught:
        _load(tmp_path, old, new)
    assert words in str(caught.value)


@pytest.mark.parametrize(
    ("given", "bounds"),
    [
        ("event: bump", (0, 0)),
        ("event: bump, at_least: 1", (1, float("inf"))),
        ("event: bump, at_most: 2", (0, 2)),
    ],
)
def test_a_bump_must_not_happen_unless_the_check_says_so(
    given: str, bounds: tuple[float, float], tmp_path: Path
) -> None:
    use = _load(tmp_path, "event: bump", given)["never"]
    found = Happens.model_validate(use.with_)
    assert (found.turtle, found.bounds) == ("robot", bounds)
