"""What `ros2` sees of the graph, against real nodes of the wheels' rclpy."""

from __future__ import annotations

import socket
from collections.abc import Iterator
from pathlib import Path

import pytest

from grader.ros.ros2_command import discovery

from .graph import Graph

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


@pytest.fixture
def graph(jazzy_prefix: Path, tmp_path: Path) -> Iterator[Graph]:
    graph = Graph(jazzy_prefix, tmp_path)
    yield graph
    graph.stop()


def start(graph: Graph, name: str, namespace: str = "/") -> None:
    graph.start("python3", "-c", NODE, name, namespace)


def test_a_node_is_listed(graph: Graph) -> None:
    start(graph, "my_first_node")
    assert graph.ros2("node", "list") == (0, "/my_first_node\n", "")


def test_an_empty_graph_lists_no_nodes_and_the_default_topics(graph: Graph) -> None:
    assert graph.ros2("node", "list") == (0, "", "")
    assert graph.ros2("topic", "list") == (0, "/parameter_events\n/rosout\n", "")
    assert graph.ros2("node", "list", "--spin-time", "0.1") == (0, "", "")


SIGNALLED = """\
import os, signal
from wheels_ros2 import graph
try:
    with graph.own_node() as node:
        os.kill(os.getpid(), signal.SIGTERM)
        while node.context.ok():
            pass
        node.get_topic_names_and_types()
except KeyboardInterrupt:
    print("interrupted")
"""


def test_sigterm_ends_a_command_at_any_moment_as_ctrl_c_does(graph: Graph) -> None:
    """Every call of rclpy fails once a signal has shut it down: no traceback says so."""
    done = graph.run("python3", "-c", SIGNALLED)
    assert done == (0, "interrupted\n", "")


@pytest.mark.full
@pytest.mark.parametrize("range_", ["LOCALHOST", "SUBNET"])
def test_the_first_answer_is_complete(jazzy_prefix: Path, tmp_path: Path, range_: str) -> None:
    """Without a daemon, and without a second look."""
    graph = Graph(jazzy_prefix, tmp_path, range_=range_)
    try:
        for name in "abcde":
            start(graph, name, f"/{name}")
            graph.ros2("topic", "list")
        listed = "".join(f"/{name}/{name}\n" for name in "abcde")
        topics = "".join(f"/{name}/chatter\n" for name in "abcde")
        for _ in range(2):
            assert graph.ros2("node", "list") == (0, listed, "")
            answer = graph.ros2("topic", "list")
            assert answer == (0, f"{topics}/parameter_events\n/rosout\n", "")
    finally:
        graph.stop()


@pytest.mark.full
def test_nodes_are_sorted_and_have_their_namespace(graph: Graph) -> None:
    start(graph, "b")
    start(graph, "a", "/lab")
    start(graph, "_hidden")
    assert graph.ros2("node", "list") == (0, "/b\n/lab/a\n", "")
    assert "/_hidden\n" in graph.ros2("node", "list", "-a").stdout
    assert graph.ros2("node", "list", "-c") == (0, "2\n", "")


def test_two_nodes_with_one_name_give_a_warning(graph: Graph) -> None:
    start(graph, "twin")
    start(graph, "twin")
    status, stdout, stderr = graph.ros2("node", "list")
    assert (status, stdout) == (0, "/twin\n/twin\n")
    assert stderr == (
        "WARNING: Be aware that there are nodes in the graph that share an exact name, which can "
        "have unintended side effects.\n"
    )
    assert graph.ros2("node", "info", "/twin").stderr.startswith("There are 2 nodes in the graph")


@pytest.mark.full
def test_topics_are_listed(graph: Graph) -> None:
    start(graph, "talker")
    plain = "/chatter\n/parameter_events\n/rosout\n"
    assert graph.ros2("topic", "list") == (0, plain, "")
    assert graph.ros2("topic", "list", "-c") == (0, "3\n", "")
    hidden = graph.ros2("topic", "list", "--include-hidden-topics")
    assert hidden == (0, f"/_private\n{plain}", "")
    assert graph.ros2("topic", "find", "std_msgs/msg/String") == (0, "/chatter\n", "")


@pytest.mark.full
def test_topics_in_detail(graph: Graph) -> None:
    start(graph, "talker")
    answer = graph.ros2("topic", "list", "-v", "--include-hidden-topics")
    assert (
        answer.stdout
        == """\
Published topics:
 * /chatter [std_msgs/msg/String] 1 publisher
 * /parameter_events [rcl_interfaces/msg/ParameterEvent] 2 publishers
 * /rosout [rcl_interfaces/msg/Log] 2 publishers

Subscribed topics:
 * /_private [std_msgs/msg/String] 1 subscriber

"""
    )


@pytest.mark.full
def test_a_question_creates_no_shared_memory(graph: Graph, tmp_path: Path) -> None:
    own = tmp_path / "own.xml"
    own.write_text(
        '<profiles xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles">'
        '<participant profile_name="own" is_default_profile="true"><rtps/></participant></profiles>'
    )
    start(graph, "talker")
    code = (
        "import os, sys; from argparse import Namespace; from wheels_ros2 import graph\n"
        "options = Namespace(spin_time=None, use_sim_time=False)\n"
        "with graph.graph(options, carries_data=sys.argv[1] == 'data') as node:\n"
        "    maps = open('/proc/self/maps').read()\n"
        "    print(graph.node_names(node)[1:], '/dev/shm/fast' in maps)\n"
        "    print(os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'])"
    )
    asked = graph.run("python3", "-c", code, "question")
    assert asked == (0, "['/talker'] False\nLOCALHOST\n", "")
    assert graph.run("python3", "-c", code, "data").stdout == "['/talker'] True\nLOCALHOST\n"
    for setting in (f"FASTRTPS_DEFAULT_PROFILES_FILE={own}", "ROS_STATIC_PEERS=192.0.2.1"):
        kept = graph.run("env", setting, "python3", "-c", code, "question")
        assert kept.stdout == "['/talker'] True\nLOCALHOST\n", kept.stderr


def test_the_udp_sockets_of_a_process_get_larger_buffers() -> None:
    size = 64 << 10  # bytes, of which the kernel makes twice as many, for its own data
    ours = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    other = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    with ours, other:
        before = other.getsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF)
        assert ours.getsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF) != 2 * size
        discovery.enlarge_buffers(size)
        assert ours.getsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF) == 2 * size
        assert other.getsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF) == before


def test_a_missing_number_is_an_endpoint_that_was_not_announced() -> None:
    participant, other = bytes(12), bytes(11) + b"\x01"
    writers = {participant + bytes([0, 0, n, 3]) for n in (1, 2, 4)}
    readers = {participant + bytes([0, 0, 3, 4]), other + bytes([0, 0, 1, 4])}
    assert discovery.has_gap(writers)
    assert not discovery.has_gap(writers | readers)
