"""The world "robot": its update rule and its scanner, and a package that is judged in it."""

from __future__ import annotations

import cmath
import math
import random
from pathlib import Path

import pytest

from grader.run.in_probe.robot import BEAMS, BOX, DT, RADIUS, SIZE, STEP, Drive, distance, is_free
from tests.test_scenarios import judged

ASSIGNMENT = """\
schema: 2
id: halt
title: "Stop before the wall"
package: doubling
nodes:
  halt: {executable: doubler, target: doubling.doubler:main, file: doubler.py, name: halt}
runs:
  - name: drives
    world: robot
    start: [{node: halt}]
    clock: {period: 0.5, ticks: 16}
    do:
      - {name: moved, at: 4.0, move: {x: 2.0, y: 6.0, theta: 3.141593}}
checks:
  - {id: run.starts, points: 1}
  - {id: run.spins, points: 1}
  - {id: hears, check: topic.subscribes, points: 1, with: {topic: /scan, type: sensor_msgs/msg/LaserScan}}
  - {id: inside, check: world.stays, points: 1, with: {margin: 0.85, at_least: 3.0}}
  - {id: never, check: world.event, points: 1, with: {event: bump}}
"""
NODE = """\
import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from sensor_msgs.msg import LaserScan


class Halt(Node):
    def __init__(self):
        super().__init__('halt')
        self.publisher = self.create_publisher(Twist, '/cmd_vel', 10)
        self.create_subscription(LaserScan, '/scan', self.on_scan, 10)

    def on_scan(self, scan):
        message = Twist()
        message.linear.x = 1.0 if scan.ranges[0] > 1.0 else 0.0
        self.publisher.publish(message)


def main():
    rclpy.init()
    try:
        rclpy.spin(Halt())
    except KeyboardInterrupt:
        pass
"""


def test_random_commands_lead_where_an_independent_sum_leads() -> None:
    chance = random.Random(14)
    for _ in range(200):
        drive, place, heading, now = Drive(x=2.5, y=2.5), 2.5 + 2.5j, 0.0, 0
        for _ in range(5):
            forward, turning = chance.uniform(-0.4, 0.4), chance.uniform(-3, 3)
            drive.command(forward, turning, now)
            for _ in range(chance.randrange(1, 20)):
                now += STEP
                assert not drive.step(now)
                heading += turning * DT
                place += cmath.rect(forward * DT, heading)
        assert abs(complex(drive.x, drive.y) - place) < 1e-9
        assert abs(cmath.rect(1, drive.theta) - cmath.rect(1, heading)) < 1e-9


def test_a_command_ends_and_walls_stop_the_robot() -> None:
    drive, touched = Drive(), 0
    drive.command(1.0, 0.0, 0)
    for n in range(1, 100):
        touched += drive.step(n * STEP)
    assert drive.x == pytest.approx(2.0 + 62 * DT)
    assert not touched
    for n in range(100, 1000):
        drive.command(1.0, 0.0, n * STEP)
        touched += drive.step(n * STEP)
    assert SIZE - RADIUS - DT < drive.x < SIZE - RADIUS
    assert touched > 500


@pytest.mark.parametrize(
    ("x", "y", "angle", "wanted"),
    [
        (2.0, 2.0, 0.0, SIZE - 2.0),
        (2.0, 2.0, math.pi / 2, SIZE - 2.0),
        (2.0, 2.0, math.pi, 2.0),
        (2.0, 5.5, 0.0, BOX[0] - 2.0),
        (7.0, 5.5, math.pi, 7.0 - BOX[2]),
        (2.0, 2.0, math.pi / 4, math.hypot(BOX[0] - 2.0, BOX[1] - 2.0)),
        (1.0, 1.0, -3 * math.pi / 4, math.sqrt(2)),
    ],
)
def test_the_scanner_measures_the_distance_to_the_nearest_wall(
    x: float, y: float, angle: float, wanted: float
) -> None:
    assert distance(x, y, angle) == pytest.approx(wanted)
    scan = Drive(x=x, y=y, theta=angle).scan()
    assert len(scan) == BEAMS
    assert scan[0] == pytest.approx(wanted)


def test_where_the_robot_fits() -> None:
    assert is_free(2.0, 2.0)
    assert not is_free(0.1, 2.0)
    assert not is_free(5.5, 5.5)
    assert not is_free(BOX[0] - RADIUS / 2, 5.5)
    assert is_free(BOX[0] - RADIUS, BOX[1] - RADIUS)  # at a corner, its round body fits


@pytest.mark.prefix
@pytest.mark.full
@pytest.mark.parametrize(
    ("old", "new", "fails"),
    [
        ("", "", {}),
        pytest.param(
            *("ranges[0] > 1.0", "ranges[0] > 0.8", {"inside": "world.hits_wall"}),
            marks=pytest.mark.long,
        ),
        (
            "1.0 if scan.ranges[0] > 1.0 else 0.0",
            "1.0",
            {"inside": "world.hits_wall", "never": "world.bumps"},
        ),
        pytest.param(
            *("1.0 if scan.ranges[0] > 1.0 else 0.0", "0.2", {"inside": "world.too_short"}),
            marks=pytest.mark.long,
        ),
    ],
)
def test_a_package_is_judged_in_it(
    old: str, new: str, fails: dict[str, str], tmp_path: Path
) -> None:
    # it reacts to scans, of which several come in each period of the clock
    report = judged(ASSIGNMENT, NODE.replace(old, new) if old else NODE, tmp_path)
    failed = {c.id: c.mistakes[0].id for c in report.checks if c.status == "failed"}
    assert failed == fails
    assert {c.id for c in report.checks if c.status == "inconclusive"} == set()
