"""A program that must end by itself: a client that asks a service once."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from grader.report.model import Report
from tests.test_scenarios import SOLUTION, marked

ASSIGNMENT = """\
schema: 2
id: asks_once
title: "A service and a client that asks once"
package: my_robot_controller
nodes:
  server: {executable: draw_circle, target: "my_robot_controller.draw_circle:main", file: draw_circle.py, name: server}
  client: {executable: test_node, target: "my_robot_controller.my_first_node:main", file: my_first_node.py, name: client}
runs:
  - name: asks
    start: [{node: server}, {node: client, arguments: ["7"], exits: true}]
    clock: {period: 0.5, ticks: 6}
checks:
  - {id: run.starts, points: 1}
  - {id: run.spins, points: 1}
  - {id: run.stays, points: 1}
  - {id: asked, check: log.matches, of: server, points: 1, with: {text: {contains: "asked"}, at_least: 1}}
  - {id: answered, check: log.matches, of: client, points: 1, with: {text: {contains: "answer 7"}, at_least: 1}}
  - {id: run.interrupt, points: 1}
"""
SERVER = """\
#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Server(Node):
    def __init__(self):
        super().__init__("server")
        self.create_service(Trigger, "ask", self.answer)

    def answer(self, request, response):
        self.get_logger().info("asked")
        response.success = True
        return response


def main():
    rclpy.init()
    rclpy.spin(Server())
"""
CLIENT = """\
#!/usr/bin/env python3
import sys

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


def main():
    rclpy.init()
    node = Node("client")
    client = node.create_client(Trigger, "ask")
    client.wait_for_service()
    future = client.call_async(Trigger.Request())
    rclpy.spin_until_future_complete(node, future)
    node.get_logger().info(f"answer {sys.argv[1]}")
    node.destroy_node()
    rclpy.shutdown()
"""


def judged(folder: Path, client: str) -> Report:
    package = folder / "ana"
    shutil.copytree(SOLUTION / "my_robot_controller", package)
    inner = package / "my_robot_controller"
    (inner / "draw_circle.py").write_text(SERVER, encoding="utf-8")
    (inner / "my_first_node.py").write_text(client, encoding="utf-8")
    entry = "'draw_circle = my_robot_controller.draw_circle:main',"
    second = "'test_node = my_robot_controller.my_first_node:main',"
    setup = (package / "setup.py").read_text("utf-8").replace(entry, f"{entry} {second}")
    (package / "setup.py").write_text(setup, encoding="utf-8")
    file = folder / "assignment.yaml"
    file.write_text(ASSIGNMENT, encoding="utf-8")
    return marked(package, file, [])


@pytest.mark.prefix
@pytest.mark.full
@pytest.mark.parametrize(
    ("old", "new", "mistake"),
    [
        ("", "", ""),
        (
            "    node.destroy_node()\n",
            "    rclpy.spin(node)\n    node.destroy_node()\n",
            "run.does_not_end",
        ),
        pytest.param(
            *("    node.destroy_node()\n", "    sys.exit(3)\n", "run.ended_early"),
            marks=pytest.mark.long,
        ),
    ],
)
def test_a_client_that_asks_once_must_end(old: str, new: str, mistake: str, tmp_path: Path) -> None:
    report = judged(tmp_path, CLIENT.replace(old, new) if old else CLIENT)
    if not mistake:
        assert {check.status for check in report.checks} == {"passed"}
        return
    failed = {check.id: check for check in report.checks if check.status == "failed"}
    assert list(failed) == ["run.stays"]
    stays = failed["run.stays"]
    assert stays.expected == "the program ends by itself, with status 0"
    assert stays.where is not None
    assert stays.where.file == "my_robot_controller/my_first_node.py"
    assert stays.mistakes[0].id == mistake
