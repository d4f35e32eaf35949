"""A path that a turtle has to drive: a right node and three that drive elsewhere, marked for real."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.test_scenarios import judged

pytestmark = [pytest.mark.prefix, pytest.mark.full]

ASSIGNMENT = """\
schema: 2
id: ring
title: "A circle of 2 m"
package: doubling
nodes:
  ring: {executable: doubler, target: doubling.doubler:main, file: doubler.py, name: ring}
runs:
  - name: drives
    world: turtlesim
    start: [{node: ring}]
    clock: {period: 0.5, ticks: 16}
checks:
  - {id: run.starts, points: 1}
  - {id: run.spins, points: 1}
  - {id: circle, check: world.path, points: 1, during: [0, 6.0], with: {turtle: turtle1, circle: {radius: 2.0, within: 0.05}}}
"""
NODE = """\
import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node


class Ring(Node):
    def __init__(self):
        super().__init__('ring')
        self.publisher = self.create_publisher(Twist, '/turtle1/cmd_vel', 10)
        self.count = 0
        self.create_timer(0.5, self.drive)

    def drive(self):
        self.count += 1
        message = Twist()
        message.linear.x = 2.0
        message.angular.z = 1.0
        self.publisher.publish(message)


def main():
    rclpy.init()
    try:
        rclpy.spin(Ring())
    except KeyboardInterrupt:
        pass
"""


@pytest.mark.parametrize(
    ("old", "new", "mistake"),
    [
        ("", "", ""),
        ("angular.z = 1.0", "angular.z = 2.0", "world.off_path"),
        *(
            pytest.param(*row, marks=pytest.mark.long)
            for row in (
                ("angular.z = 1.0", "angular.z = -1.0", ""),  # the same circle, the other way round
                ("angular.z = 1.0", "angular.z = (-1.0) ** (self.count // 4)", "world.off_path"),
                ("message.linear.x = 2.0", "message.linear.y = 0.0", "world.stands_still"),
                ("message.angular.z = 1.0", "pass", "world.off_path"),
            )
        ),
    ],
)
def test_a_turtle_on_a_circle(old: str, new: str, mistake: str, tmp_path: Path) -> None:
    assert not old or NODE.count(old) == 1
    report = judged(ASSIGNMENT, NODE.replace(old, new) if old else NODE, tmp_path)
    found = {check.id: check for check in report.checks}
    assert found["run.spins"].status == "passed"
    circle = found["circle"]
    assert circle.status == ("failed" if mistake else "passed"), circle.actual
    assert [one.id for one in circle.mistakes[:1]] == ([mistake] if mistake else [])
