"""The period that a change writes: the assignment's; if it names none, the program's own; or none."""

from __future__ import annotations

import pytest

from grader.course.assignment import Assignment
from grader.course.find import assignment_file
from grader.course.load import load_assignment
from grader.mistakes.catalogue import CATALOGUE, fixes_for
from grader.mistakes.fixes.case import Case, Finding
from grader.mistakes.recognise import behind_symptom
from grader.mistakes.recognised import Suspect
from grader.package.edit.files import Files
from grader.package.source.node import read_node
from tests.fixing import first_fix

IN_INIT = "        while rclpy.ok():\n            self.publish()\n            time.sleep({0})\n"
SOURCE = """\
import time

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node


class Driver(Node):
    def __init__(self):
        super().__init__('driver')
        self.pause = 0.25
        self.pub = self.create_publisher(Twist, '/turtle1/cmd_vel', 10)
{0}
    def publish(self):
        self.pub.publish(Twist())


def main(args=None):
    rclpy.init(args=args)
    rclpy.spin(Driver())
"""


def lesson(name: str) -> Assignment:
    return load_assignment(assignment_file(name))


def told(assignment: Assignment, slept: str) -> tuple[str, str]:
    """Return the text of the fix, and the node's file after it ("" if none is certain)."""
    path = f"{assignment.folder}/{assignment.node_file}"
    files = Files({}).with_data(path, SOURCE.format(IN_INIT.format(slept)).encode())
    source = read_node(files.data, path, "main")
    assert source is not None
    found = behind_symptom("run.never_spins", Suspect(source, assignment))
    assert found is not None
    assert found.where is not None
    finding = Finding("run.spins", found.kind, dict(found.params), path, found.where.line)
    new = first_fix(Case(files, finding, assignment), fixes_for(finding))
    text = CATALOGUE[found.kind].fix_text({**found.params, **found.words}, found.variant)
    return str(text), "" if new is None else (new.data(path) or b"").decode()


@pytest.mark.parametrize(
    ("name", "slept", "wanted"),
    [
        ("draw_circle", "0.5", "0.5"),
        ("draw_circle", "2.0", "0.5"),  # what this lesson's check asks for
        ("hello_time", "0.5", "1.0"),
        ("stay_inside", "0.2", "0.2"),  # no check names a period
        ("stay_inside", "self.pause", "self.pause"),
    ],
)
def test_a_timer_for_a_loop_gets_the_period_of_this_assignment_or_of_the_loop(
    name: str, slept: str, wanted: str
) -> None:
    text, new = told(lesson(name), slept)
    made = f"self.create_timer({wanted}, self.publish)"
    assert made in text
    assert f"        {made}\n" in new
    assert "while" not in new


def test_a_period_that_nothing_names_is_left_open_and_no_change_writes_it() -> None:
    text, new = told(lesson("stay_inside"), "pause()")
    assert "self.create_timer(…, self.publish)" in text
    assert new == ""


def test_an_assignment_with_two_periods_names_none() -> None:
    circle = lesson("draw_circle")
    assert (circle.period, circle.seconds) == (0.5, "0.5")
    (period,) = [use for use in circle.checks if use.id == "drive.period"]
    other = period.model_copy(update={"id": "other", "with_": {**period.with_, "period": 2.0}})
    both = circle.model_copy(update={"checks": (*circle.checks, other)})
    assert (both.period, both.seconds) == (None, "…")
