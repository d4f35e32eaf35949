"""What the instructor keeps back shows nowhere on the graph that the student's node sees."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.base.unheard import unheard
from grader.course.load import load_assignment
from grader.report.model import Report
from grader.ros.distro import find_distro
from grader.verdict.checks.all import CHECKS
from grader.verdict.evidence_file import Judged
from grader.verdict.mark import grade
from grader.verdict.order import Order
from tests.marking import LIMITS
from tests.scenario_kinds import write_files

ASSIGNMENT = """\
schema: 2
id: looking
title: "A node that looks around"
package: doubling
nodes:
  looker: {{executable: doubler, target: doubling.doubler:main, file: doubler.py, name: looker}}
hidden_checks: {count}
runs:
  - name: looks
    start: [{{node: looker}}]
    clock: {{period: 0.5, ticks: 12}}
    do:
      - {{name: three, at: 3.0, set: {{looker: {{known: 3}}}}}}
      - {{name: again, at: 4.0, call: {{service: /again, type: std_srvs/srv/Trigger}}}}
checks:
  - {{id: run.starts, points: 1}}
  - {{id: run.spins, points: 1}}
  - {{id: known, check: topic.publishes, points: 1, with: {{topic: /known, type: std_msgs/msg/Int32, at_least: 10}}}}
"""
HIDDEN = """\
checks:
  - {id: also, check: topic.publishes, points: 1, with: {topic: /also, type: std_msgs/msg/Int32, at_least: 10}}
  - {id: best, check: topic.publishes, points: 1, with: {topic: /best, type: std_msgs/msg/Int32, at_least: 10}}
  - {id: later, check: topic.publishes, points: 1, with: {topic: /later, type: std_msgs/msg/Int32, at_least: 3}}
  - {id: secret, check: topic.publishes, points: 1, with: {topic: /secret, type: geometry_msgs/msg/Twist}}
  - {id: typed, check: topic.publishes, points: 1, with: {topic: /typed, type: geometry_msgs/msg/Pose}}
  - {id: heard, check: topic.subscribes, points: 1, with: {topic: /secret_too, type: std_msgs/msg/Bool}}
  - {id: offers, check: service.offers, points: 1, with: {service: /secret_service, type: std_srvs/srv/Trigger}}
  - {id: calls, check: service.calls, points: 1, with: {service: /secret_call, type: std_srvs/srv/SetBool}}
  - {id: acts, check: action.offers, points: 1, with: {action: /secret_action, type: turtlesim/action/RotateAbsolute}}
  - {id: declares, check: parameter.declared, points: 1, with: {name: secret_parameter, type: integer}}
"""
NODE = """\
#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import Int32, String
from std_srvs.srv import Trigger

GUESSES = ('/known', '/also', '/best', '/later', '/typed', '/mine', '/secret', '/secret_too')
BEST = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)


class Looker(Node):
    def __init__(self):
        super().__init__('looker')
        self.declare_parameter('known', 1)
        self.n = 0
        self.create_service(Trigger, '/again', lambda request, reply: reply)
        self.heard = self.create_subscription(Int32, '/heard', lambda message: None, 10)
        self.numbers = [self.create_publisher(Int32, name, 10) for name in GUESSES[:2]]
        self.numbers.append(self.create_publisher(Int32, '/best', BEST))
        self.texts = [self.create_publisher(String, name, 10) for name in ('/typed', '/mine')]
        self.create_timer(0.5, self.look)

    def look(self):
        self.n += 1
        if self.n == 6:
            self.numbers.append(self.create_publisher(Int32, '/later', 10))
        for publisher in self.numbers:
            publisher.publish(Int32(data=self.n))
        for publisher in self.texts:
            publisher.publish(String(data='text'))
        found = [('topics', sorted(self.get_topic_names_and_types()))]
        found.append(('services', sorted(self.get_service_names_and_types())))
        for name, space in sorted(self.get_node_names_and_namespaces()):
            found.append((name, [sorted(read(name, space)) for read in (
                self.get_publisher_names_and_types_by_node,
                self.get_subscriber_names_and_types_by_node,
                self.get_service_names_and_types_by_node,
                self.get_client_names_and_types_by_node)]))
        for topic in GUESSES:
            ends = [(info.node_name, info.topic_type, info.qos_profile.reliability.name,
                     info.qos_profile.durability.name, info.qos_profile.depth)
                    for info in self.get_subscriptions_info_by_topic(topic)]
            found.append((topic, self.count_publishers(topic), self.count_subscribers(topic),
                          sorted(ends)))
        for one in found:
            self.get_logger().info(f'at {self.n}: {one}')


def main(args=None):
    rclpy.init(args=args)
    node = Looker()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
"""
MEETING = ("at 7:", "at 8:")  # when node and probe get to know the ends of /later


def seen(folder: Path, hidden: str) -> tuple[Report, list[str]]:
    """Return the report of the node that looks around, and what it logs of the graph."""
    folder.mkdir()
    (folder / "assignment.yaml").write_text(ASSIGNMENT.format(count=hidden.count("{id:")))
    (folder / "hidden.yaml").write_text(hidden)
    write_files(folder / "doubling", NODE)
    file = folder / "assignment.yaml"
    extra = folder / "hidden.yaml" if hidden else None
    assignment = load_assignment(file, hidden=extra, known_checks=CHECKS)
    distro, limits = find_distro("jazzy"), LIMITS.override(assignment.limits)
    order = Order(
        path=folder / "doubling",
        assignment=assignment,
        distro=distro,
        sandbox="bubblewrap",
        limits=limits,
    )
    kept = list[Judged]()
    report = grade(order, unheard, keep=kept.append)
    (run,) = kept[0].recording.scenarios
    lines = [event.text for event in run.watch.events if event.text.startswith("at ")]
    return report, [line for line in lines if not line.startswith(MEETING)]


@pytest.mark.prefix
@pytest.mark.full
def test_a_node_that_logs_the_whole_graph_sees_nothing_of_hidden_checks(tmp_path: Path) -> None:
    report, with_hidden = seen(tmp_path / "hidden", HIDDEN)
    _, without = seen(tmp_path / "visible", "")
    assert len(without) >= 10 * 12
    assert all(len(line) < 2_000 for line in without), "a record is cut there"
    assert with_hidden == without
    assert not any("/secret'" in line for line in without if "topics" in line)
    status = {check.id: check.status for check in report.checks}
    assert [name for name, found in status.items() if found == "passed"] == [
        *("run.starts", "run.spins", "known", "also", "best", "later")
    ]
    kept = (
        "secret_service",
        "secret_call",
        "secret_action",
        "secret_parameter",
        "Twist",
        "Pose",
        "SetBool",
        "RotateAbsolute",
    )
    assert [line for line in with_hidden if any(name in line for name in kept)] == []


def test_only_topics_of_hidden_checks_are_kept_back(tmp_path: Path) -> None:
    (tmp_path / "assignment.yaml").write_text(ASSIGNMENT.format(count=HIDDEN.count("{id:")))
    (tmp_path / "hidden.yaml").write_text(HIDDEN)
    place = tmp_path / "assignment.yaml"
    found = load_assignment(place, hidden=tmp_path / "hidden.yaml", known_checks=CHECKS)
    assert found.runs[0].kept_back == ("/also", "/best", "/later", "/secret", "/typed")
    assert load_assignment(place, known_checks=CHECKS).runs[0].kept_back == ()
    given = ASSIGNMENT.format(count=HIDDEN.count("{id:"))
    place.write_text(given.replace("    do:", "    topics: {/also: std_msgs/msg/Int32}\n    do:"))
    found = load_assignment(place, hidden=tmp_path / "hidden.yaml", known_checks=CHECKS)
    assert "/also" not in found.runs[0].kept_back, "the students' file names it"
