"""The period that a change writes: the assignment's; if it names none, the program's own; or none."""

from __future__ import annotations

from grader.course.assignment import Assignment
from grader.course.find import assignment_file
from grader.course.load import load_assignment


def lesson(name: str) -> Assignment:
    return load_assignment(assignment_file(name))


def test_an_assignment_with_two_periods_names_none() -> None:
    circle = lesson("draw_circle")
    assert (circle.period, circle.seconds) == (0.5, "0.5")
    (period,) = [use for use in circle.checks if use.id == "drive.period"]
    other = period.model_copy(update={"id": "other", "with_": {**period.with_, "period": 2.0}})
    both = circle.model_copy(update={"checks": (*circle.checks, other)})
    assert (both.period, both.seconds) == (None, "…")
