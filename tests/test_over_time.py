"""Right nodes whose publishers, timers and goals come and go in the course of a run."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.test_scenarios import judged

pytestmark = [pytest.mark.prefix, pytest.mark.full]

ASSIGNMENT = """\
schema: 2
id: over_time
title: "In the course of a run"
package: doubling
nodes:
  node: {executable: doubler, target: doubling.doubler:main, file: doubler.py, name: over_time}
runs:
  - name: lives
    start: [{node: node}]
    clock: {period: 0.5, ticks: 16}
    do:
      - {name: wait, at: 1.0, goal: {action: /wait, type: turtlesim/action/RotateAbsolute}}
      - {name: open, at: 2.0, call: {service: /open, type: std_srvs/srv/SetBool, values: {data: true}}}
      - {name: turn, at: 2.5, goal: {action: /turn, type: turtlesim/action/RotateAbsolute}}
      - {name: enough, at: 3.0, cancel: turn}
      - {name: close, at: 5.0, call: {service: /open, type: std_srvs/srv/SetBool}}
checks:
  - {id: run.starts, points: 1}
  - {id: run.spins, points: 1}
  - {id: late, check: topic.publishes, after: open, during: [0, 3], points: 1, with: {topic: /late, type: std_msgs/msg/Bool, at_least: 5}}
  - {id: half, check: topic.publishes, points: 1, with: {topic: /half, type: std_msgs/msg/Bool}}
  - {id: half.period, check: topic.period, points: 1, with: {topic: /half, period: 0.5}}
  - {id: wait.feedback, check: action.feedback, after: wait, points: 1, with: {action: /wait, at_least: 50}}
  - {id: turn.cancel, check: action.cancels, after: enough, points: 1, with: {action: /turn, within: 0.5}}
"""
NODE = """\
import time

import rclpy
from rclpy.action import ActionServer, CancelResponse
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import Bool
from std_srvs.srv import SetBool
from turtlesim.action import RotateAbsolute


class OverTime(Node):
    def __init__(self):
        super().__init__('over_time')
        self.count = 0
        self.late = self.waiting = None
        self.half = self.create_publisher(Bool, '/half', 10)
        self.create_service(SetBool, '/open', self.on_open)
        self.create_timer(0.25, self.on_timer)
        self.wait = ActionServer(self, RotateAbsolute, '/wait', self.on_wait)
        self.turn = ActionServer(self, RotateAbsolute, '/turn', self.on_turn,
                                 cancel_callback=lambda _: CancelResponse.ACCEPT)

    def on_open(self, request, response):
        if request.data:
            self.late = self.create_publisher(Bool, '/late', 10)
        else:
            self.destroy_publisher(self.late)
            self.late = None
        response.success = True
        return response

    def on_timer(self):
        self.count += 1
        if self.count % 2 == 0:
            self.half.publish(Bool(data=True))
            if self.late:
                self.late.publish(Bool(data=True))
        if self.waiting and self.count == 18:
            self.waiting.set_result(True)
            self.waiting = None

    def on_wait(self, handle):
        for _ in range(3):
            time.sleep(0.02)
            handle.publish_feedback(RotateAbsolute.Feedback())
        handle.succeed()
        return RotateAbsolute.Result()

    async def on_turn(self, handle):
        self.waiting = Future()
        await self.waiting
        handle.canceled()
        return RotateAbsolute.Result()


def main():
    rclpy.init()
    try:
        rclpy.spin(OverTime())
    except KeyboardInterrupt:
        pass
"""


def test_a_publisher_a_timer_and_goals_that_change_in_the_run(tmp_path: Path) -> None:
    """One run shows all of it: each has failed or was told wrongly though nothing was busy."""
    checks = {check.id: check for check in judged(ASSIGNMENT, NODE, tmp_path).checks}
    failed = {check.id for check in checks.values() if check.status != "passed"}
    assert failed == {"wait.feedback", "turn.cancel"}

    wait = checks["wait.feedback"]
    assert wait.mistakes[0].id == "action.no_feedback"
    assert "wall time" in wait.rationale
    assert "ROS time" in wait.fix
    assert wait.where is not None
    assert wait.where.line is not None
    assert NODE.splitlines()[wait.where.line - 1].strip() == "time.sleep(0.02)"

    # the 18th call of a timer of 0.25 s
    cancel = checks["turn.cancel"]
    assert "4.5 s" in cancel.actual
    assert "1.5 s after" in cancel.actual
