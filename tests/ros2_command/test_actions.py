"""`ros2 action` with a real action server, and interfaces of the prefix with turtlesim's."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from grader.ros.interfaces import with_interfaces
from grader.ros.prefix import Ros

from .graph import Graph

pytestmark = [pytest.mark.prefix, pytest.mark.full]

TYPE = "turtlesim/action/RotateAbsolute"
SENT = "Waiting for an action server to become available...\nSending goal:\n     theta: {}\n\n"
ACCEPTED = r"Goal accepted with ID: [0-9a-f]{32}\n\n"


@pytest.fixture(scope="module")
def turner(ros_jazzy: Ros, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Graph]:
    prefix = with_interfaces(ros_jazzy, notify=print).path
    graph = Graph(prefix, tmp_path_factory.mktemp("turner"))
    graph.start("python3", str(Path(__file__).with_name("turner.py")))
    yield graph
    graph.stop()


def test_an_action_is_listed_with_its_server(turner: Graph) -> None:
    assert turner.ros2("action", "list", "-t") == (0, f"/rotate [{TYPE}]\n", "")
    assert turner.ros2("action", "type", "/rotate") == (0, f"{TYPE}\n", "")
    assert turner.ros2("action", "type", "/nope") == (1, "", "")
    assert turner.ros2("action", "info", "/rotate") == (
        0,
        "Action: /rotate\nAction clients: 0\nAction servers: 1\n    /turner\n",
        "",
    )
    info = turner.ros2("node", "info", "/turner").stdout
    assert f"  Action Servers:\n    /rotate: {TYPE}\n" in info
    assert "_action" not in info
    assert "_action" not in turner.ros2("topic", "list").stdout


def test_a_goal_is_reached_with_feedback(turner: Graph) -> None:
    done = turner.ros2("action", "send_goal", "--feedback", "/rotate", TYPE, "{theta: 1.5}")
    assert (done.status, done.stderr) == (0, "")
    assert re.fullmatch(
        re.escape(SENT.format(1.5)) + ACCEPTED + r"(Feedback:\n    remaining: 0\.5\n\n)+"
        r"Result:\n    delta: 1\.0\n\nGoal finished with status: SUCCEEDED\n",
        done.stdout,
    )


def test_a_goal_is_rejected(turner: Graph) -> None:
    done = turner.ros2("action", "send_goal", "/rotate", TYPE, "{theta: -1}")
    assert done == (0, SENT.format(-1.0) + "Goal was rejected.\n", "")


def test_ctrl_c_cancels_the_goal(turner: Graph) -> None:
    command = ("ros2", "action", "send_goal", "/rotate", TYPE, "{theta: 4}")
    done = turner.interrupted(*command, after="Goal accepted", times=1)
    assert done.stdout.endswith("Canceling goal...\nGoal canceled.\n")
    assert (done.status, done.stderr) == (2, "")


def test_what_is_no_goal_is_one_line(turner: Graph) -> None:
    done = turner.ros2("action", "send_goal", "/rotate", TYPE, "{angle: 1}")
    assert (done.status, done.stdout) == (1, "")
    assert done.stderr.startswith("Failed to populate message fields: AttributeError")
    done = turner.ros2("action", "send_goal", "/rotate", "turtlesim/action/Nope", "{}")
    assert (done.status, done.stderr) == (1, "The passed action type is invalid\n")


def test_an_action_is_shown(turner: Graph) -> None:
    fields = turner.ros2("interface", "show", "--no-comments", TYPE).stdout
    assert fields == "float32 theta\n---\nfloat32 delta\n---\nfloat32 remaining\n"
    assert turner.ros2("interface", "proto", TYPE).stdout == '"theta: 0.0\n"\n'
