"""Packages of interfaces without a wheel: built when an assignment names them, or told at once."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from grader.cli.main import main
from tests.processes import ROOT

SOLUTION = ROOT / "grader" / "keys" / "draw_circle" / "solution" / "my_robot_controller"

ASSIGNMENT = """\
schema: 2
id: adds
title: "A service that adds"
package: my_robot_controller
nodes:
  adder: {executable: draw_circle, target: my_robot_controller.draw_circle:main, file: draw_circle.py, name: adder}
runs:
  - name: adds
    start: [{node: adder}]
    clock: {period: 0.5, ticks: 6}
    do:
      - {name: sum, at: 1.0, call: {service: /add, type: example_interfaces/srv/AddTwoInts, values: {a: 2, b: 3}}}
      - {name: chain, at: 2.0, publish: {topic: /tf, type: tf2_msgs/msg/TFMessage, values: {transforms: [{child_frame_id: laser}]}}}
checks:
  - {id: package.found, points: 1}
  - {id: run.starts, points: 1}
  - {id: run.spins, points: 1}
  - {id: five, check: service.answers, after: sum, points: 1, with: {service: /add, within: 0.5, each: {sum: 5}}}
  - {id: hears, check: topic.subscribes, points: 1, with: {topic: /tf, type: tf2_msgs/msg/TFMessage}}
  - {id: names, check: log.matches, after: chain, points: 1, with: {text: {contains: laser}}}
"""
NODE = """\
#!/usr/bin/env python3
import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.node import Node
from tf2_msgs.msg import TFMessage


class Adder(Node):
    def __init__(self):
        super().__init__("adder")
        self.create_service(AddTwoInts, "add", self.add)
        self.create_subscription(TFMessage, "tf", self.hear, 10)

    def add(self, request, response):
        response.sum = request.a + request.b
        return response

    def hear(self, message):
        self.get_logger().info(message.transforms[0].child_frame_id)


def main():
    rclpy.init()
    rclpy.spin(Adder())
"""


def written(folder: Path, assignment: str) -> list[str]:
    package = folder / "ana"
    shutil.copytree(SOLUTION, package)
    (package / "my_robot_controller" / "draw_circle.py").write_text(NODE, encoding="utf-8")
    (folder / "assignment.yaml").write_text(assignment, encoding="utf-8")
    options = ["--sandbox", "bubblewrap", "--out", str(folder / "out")]
    return ["grade", str(package), "--assignment", str(folder / "assignment.yaml"), *options]


@pytest.mark.prefix
def test_a_package_that_ros_does_not_have_is_told_before_anything_is_built(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    missing = ASSIGNMENT.replace("example_interfaces/srv/AddTwoInts", "control_msgs/srv/AddTwoInts")
    missing = missing.replace("tf2_msgs/msg/TFMessage", "std_msgs/msg/String")
    missing = missing.replace("{transforms: [{child_frame_id: laser}]}", "{data: laser}")
    assert main(written(tmp_path, missing)) == 2
    said = capsys.readouterr().err
    assert "ROS jazzy has no package control_msgs" in said
    assert "interface_packages" in said
    assert "building with colcon" not in said


@pytest.mark.prefix
@pytest.mark.long
def test_the_tutorials_interfaces_are_built_and_used(tmp_path: Path) -> None:
    assert main(written(tmp_path, ASSIGNMENT)) == 0
