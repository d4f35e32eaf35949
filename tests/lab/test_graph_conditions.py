"""Steps that are done once something of the lesson was on the ROS graph, with the wheels' rclpy."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path

import pexpect
import pytest

from tests import processes
from tests.lab.test_lab_commands import Watch
from tests.lab.workspaces import EXECUTABLE, MARKER, put
from tests.ros2_command.graph import Graph

pytestmark = [pytest.mark.prefix, pytest.mark.full]

COURSE = processes.ROOT / "lab/course/hello_time"
LESSON = """# An instructor's own lesson

## 1. Run the node
<!-- done: node_on_graph /lab/talker -->

Run it.

## 2. Publish
<!-- done: topic_published /lab/chatter -->

Publish.

## 3. Ready

That is all.
"""
NODE = """\
import rclpy
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node("talker", namespace="/lab")
print("ready", flush=True)
input()
publisher = node.create_publisher(String, "chatter", 1)
print("publishes", flush=True)
input()
"""


@pytest.fixture
def graph(jazzy_prefix: Path, tmp_path: Path) -> Iterator[Graph]:
    graph = Graph(jazzy_prefix, tmp_path)
    yield graph
    graph.stop()


@pytest.fixture
def home(tmp_path: Path) -> Path:
    """A home with a workspace that is built, and the lesson."""
    put(tmp_path / "ros2_ws", MARKER, EXECUTABLE)
    lesson = tmp_path / "lesson"
    lesson.mkdir()
    (lesson / "assignment.yaml").write_bytes((COURSE / "assignment.yaml").read_bytes())
    (lesson / "lesson.md").write_text(LESSON, encoding="utf-8")
    return tmp_path


def surroundings(graph: Graph, home: Path) -> dict[str, str]:
    """Return the environment of a terminal with ROS and the workspace sourced."""
    listed = graph.run("env", "-0").stdout.split("\0")
    ros = dict(line.split("=", 1) for line in listed if "=" in line)
    overlay = f"{home}/ros2_ws/install/my_robot_controller:{ros['AMENT_PREFIX_PATH']}"
    lesson = {"GRADER_ASSIGNMENT": str(home / "lesson/assignment.yaml")}
    python = f"{processes.ROOT}:{ros['PYTHONPATH']}"
    return {**ros, **lesson, "HOME": str(home), "AMENT_PREFIX_PATH": overlay, "PYTHONPATH": python}


def guide(env: dict[str, str], *words: str) -> str:
    done = processes.run([sys.executable, "-m", "lab.guide", *words], env=env)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_what_was_seen_on_the_graph_stays_done(graph: Graph, home: Path) -> None:
    env = surroundings(graph, home)
    first = guide(env)
    assert "1 of 3: Run the node" in first
    assert "ros2 run my_robot_controller test_node" in first
    assert "the node /lab/talker runs" in first
    node = graph.start("python3", "-c", NODE)
    assert "2 of 3: Publish" in (said := guide(env))
    assert "a node publishes /lab/chatter" in said
    assert node.stdin is not None and node.stdout is not None
    node.stdin.write("\n")
    node.stdin.flush()
    assert node.stdout.readline() == "publishes\n"
    assert "3 of 3: Ready" in guide(env)
    node.communicate("\n")
    assert "3 of 3: Ready" in guide(env)


def test_the_watch_looks_at_the_graph(graph: Graph, home: Path) -> None:
    watch = Watch(home, **surroundings(graph, home))
    graph.start("python3", "-c", NODE)
    watch.shows("Done: 1. Run the node")
    watch.shows("Step 2 of 3")
    watch.press("q")
    watch.screen.expect(pexpect.EOF)


def test_without_ros2_nothing_was_seen(graph: Graph, home: Path) -> None:
    graph.start("python3", "-c", NODE)
    env = {**surroundings(graph, home), "PATH": os.defpath}
    assert "1 of 3: Run the node" in guide(env)
