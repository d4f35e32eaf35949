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
BY_TELEPORT = """\
import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from turtlesim.srv import TeleportRelative


class Ring(Node):
    def __init__(self):
        super().__init__('ring')
        self.publisher = self.create_publisher(Twist, '/turtle1/cmd_vel', 10)
        self.client = self.create_client(TeleportRelative, '/turtle1/teleport_relative')
        self.turn = 0.05
        self.create_timer(0.1, self.drive)

    def drive(self):
        # 0.2 m and 0.1 rad at once: points on a circle of 2 m, as exact as one that is driven
        self.client.call_async(TeleportRelative.Request(linear=0.2, angular=self.turn))
        self.turn = 0.1


def main():
    rclpy.init()
    try:
        rclpy.spin(Ring())
    except KeyboardInterrupt:
        pass
"""
FINER = "{period: 0.1, ticks: 80}\n    topics: {/turtle1/pose: turtlesim/msg/Pose}"
STAYS = "  - {id: stays, check: world.stays, points: 1, with: {turtle: turtle1, at_least: 5.0}}\n"


@pytest.mark.parametrize(
    ("old", "new", "mistake"),
    [
        ("angular.z = 1.0", "angular.z = 2.0", "world.off_path"),
        *(
            pytest.param(*row, marks=pytest.mark.long)
            for row in (
                ("", "", ""),
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
    assert [one.id for one in circle.mistakes[-1:]] == ([mistake] if mistake else [])


@pytest.mark.long
def test_a_turtle_that_is_put_along_a_circle_has_not_driven(tmp_path: Path) -> None:
    finer = ASSIGNMENT.replace("{period: 0.5, ticks: 16}", FINER)
    report = judged(finer + STAYS, BY_TELEPORT, tmp_path)
    found = {check.id: check for check in report.checks}
    assert found["run.spins"].status == "passed"
    # it was there: the same points pass where nothing says that they were not driven
    (way,) = (run.path["turtle1"] for run in report.runs)
    assert max(y for _, y in way) - min(y for _, y in way) == pytest.approx(4.0, abs=0.1)
    assert [one.id for one in found["circle"].mistakes[:1]] == ["world.off_path"]
    assert "it does not drive there" in found["circle"].actual
    assert [one.id for one in found["stays"].mistakes[:1]] == ["world.stands_still"]
