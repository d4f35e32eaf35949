"""Which end of a topic a node has: right, swapped, and only one, marked for real."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.test_scenarios import judged

pytestmark = [pytest.mark.prefix, pytest.mark.full]

ASSIGNMENT = """\
schema: 2
id: twice
title: "A node that doubles"
package: doubling
nodes:
  twice: {executable: doubler, target: doubling.doubler:main, file: doubler.py, name: twice}
runs:
  - name: answers
    start: [{node: twice}]
    clock: {period: 0.5, ticks: 6}
    do:
      - {name: four, at: 1.0, publish: {topic: /number, type: std_msgs/msg/Int32, values: {data: 4}}}
checks:
  - {id: run.starts, points: 1}
  - {id: run.spins, points: 1}
  - {id: hears, check: topic.subscribes, points: 1, with: {topic: /number, type: std_msgs/msg/Int32}}
  - {id: says, check: topic.publishes, points: 1, with: {topic: /doubled, type: std_msgs/msg/Int32}}
"""
NODE = """\
import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Twice(Node):
    def __init__(self):
        super().__init__('twice')
        self.publisher_ = self.create_publisher(Int32, '/doubled', 10)
        self.create_subscription(Int32, '/number', self.on_number, 10)

    def on_number(self, message):
        self.publisher_.publish(Int32(data=2 * message.data))


def main():
    rclpy.init()
    try:
        rclpy.spin(Twice())
    except KeyboardInterrupt:
        pass
"""
SWAPPED = (
    NODE.replace("/doubled", "/third").replace("/number", "/doubled").replace("/third", "/number")
)


@pytest.mark.parametrize(
    ("node", "fails"),
    [
        pytest.param(NODE, {}, id="right", marks=pytest.mark.long),
        pytest.param(
            SWAPPED, {"hears": "topic.wrong_end", "says": "topic.wrong_end"}, id="swapped"
        ),
        pytest.param(
            NODE.replace(
                "        self.create_subscription(Int32, '/number', self.on_number, 10)\n", ""
            ),
            {"hears": "topic.no_subscription"},  # and so nothing is published
            id="no subscription",
            marks=pytest.mark.long,
        ),
    ],
)
def test_the_end_of_a_topic(node: str, fails: dict[str, str], tmp_path: Path) -> None:
    report = judged(ASSIGNMENT, node, tmp_path)
    failed = {c.id: c.mistakes[0].id for c in report.checks if c.status == "failed"}
    assert failed == fails
