"""What the recordings do not have: options of the verbs, values of parameters, actions, completion."""

from __future__ import annotations

import re
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from .graph import WORLD, Graph

pytestmark = [pytest.mark.prefix, pytest.mark.full]

ROOT = Path(__file__).parents[2]
COMPLETION = ROOT / "lab" / "shell" / "completion.bash"
COMPLETE = """\
source "$0"
COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
_lab_ros2
printf '%s\\n' "${COMPREPLY[@]}"
"""
MANAGED = """\
import rclpy
from rclpy.lifecycle import LifecycleNode
rclpy.init()
node = LifecycleNode("managed")
print("ready", flush=True)
rclpy.spin(node)
"""
POSE = "geometry_msgs/msg/PoseStamped"


@pytest.fixture(scope="module")
def world(jazzy_prefix: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Graph]:
    graph = Graph(jazzy_prefix, tmp_path_factory.mktemp("verbs"))
    graph.start("python3", str(WORLD))
    graph.start("python3", "-c", MANAGED)
    yield graph
    graph.stop()


def publish(world: Graph, topic: str, kind: str, values: str) -> None:
    """Publish ten times a second until the end of the tests."""
    ros2 = ("ros2", "topic", "pub", "-r", "10", topic, kind, values)
    world.start(*ros2, ready="publisher: beginning loop\n")


def echoed(world: Graph, topic: str, *options: str) -> str:
    done = world.ros2("topic", "echo", "--once", topic, *options)
    assert (done.status, done.stderr) == (0, "")
    return done.stdout


def test_messages_are_printed_as_the_options_ask(world: Graph) -> None:
    values = "{layout: {data_offset: 7, dim: [{label: abcdef, size: 2}]}, data: [1.5, 2, 3]}"
    publish(world, "/array", "std_msgs/msg/Float64MultiArray", values)
    layout = "layout:\n  dim:\n  - label: {}\n    size: 2\n    stride: 0\n  data_offset: 7\n"
    data = "data:\n- 1.5\n- 2.0\n- 3.0\n"
    assert echoed(world, "/array") == f"{layout.format('abcdef')}{data}---\n"
    assert echoed(world, "/array", "-l", "2") == (
        f"{layout.format('ab...')}data:\n- 1.5\n- 2.0\n- '...'\n---\n"
    )
    assert echoed(world, "/array", "--no-arr") == (
        "layout:\n  dim: '<sequence type: std_msgs/MultiArrayDimension, length: 1>'\n"
        "  data_offset: 7\ndata: '<sequence type: double, length: 3>'\n---\n"
    )
    assert "label: '<string length: <6>>'" in echoed(world, "/array", "--no-str")
    assert echoed(world, "/array", "--csv") == "abcdef,2,0,7,1.5,2.0,3.0\n"
    assert echoed(world, "/array", "--field", "layout.data_offset") == "7\n---\n"
    assert echoed(world, "/array", "--filter", "m.data[0] > 1").startswith("layout:")
    assert echoed(world, "/array", "--field", "layout", "--flow-style").startswith("{dim: [{label:")


def test_what_cannot_be_echoed_is_one_line(world: Graph) -> None:
    for options, error in (
        (["--field", "nope"], "Invalid field 'nope': 'String' object has no attribute 'nope'\n"),
        (["--filter", "m."], "The filter is not a Python expression: invalid syntax\n"),
        (["nope/msg/X"], "The passed message type is invalid\n"),
    ):
        done = world.ros2("topic", "echo", "--once", "/chatter", *options)
        assert (done.status, done.stdout, done.stderr) == (1, "", error)
    done = world.ros2("topic", "echo", "/not a name")
    assert (done.status, done.stdout, "Traceback" in done.stderr) == (1, "", False)
    assert done.stderr


def test_echo_ends_after_its_timeout_and_with_its_reader(world: Graph) -> None:
    assert world.ros2("topic", "echo", "--timeout", "0.5", "/turtle1/cmd_vel").status == 0
    done = world.run("bash", "-c", "ros2 topic echo /chatter | head -n 1; echo ${PIPESTATUS[0]}")
    assert done == (0, "data: hello\n1\n", "")


def test_pub_publishes_as_often_as_asked_and_stamps_headers(world: Graph) -> None:
    twist = ("/turtle1/cmd_vel", "geometry_msgs/msg/Twist")
    done = world.ros2("topic", "pub", "--times", "3", "-r", "20", "-p", "2", *twist)
    assert re.findall(r"publishing #(\d)", done.stdout) == ["2"]
    assert done.status == 0
    before = time.time()
    done = world.ros2("topic", "pub", "-w", "0", "--once", "/pose", POSE, "{header: auto}")
    sent = re.search(r"sec=(\d+)", done.stdout)
    assert sent
    assert int(before) <= int(sent[1]) <= time.time()
    done = world.ros2("topic", "pub", "--once", "--max-wait-time-secs", "0.3", "/alone", POSE)
    assert (done.status, done.stdout.count("Waiting for at least 1")) == (1, 1)
    assert done.stderr.startswith("Timed out waiting for subscribers: Expected 1")


def test_values_that_do_not_fit_are_one_line(world: Graph) -> None:
    for values, error in (
        ("{lin: 1}", "Failed to populate field: 'Twist' object has no attribute 'lin'\n"),
        ("[1]", "The passed value needs to be a dictionary in YAML format\n"),
        ("{linear: 2}", "Failed to populate field: Value '2' is expected to be a dictionary"),
    ):
        done = world.ros2("topic", "pub", "--once", "/t", "geometry_msgs/msg/Twist", values)
        assert (done.status, done.stdout) == (1, "")
        assert done.stderr.startswith(error)
        assert len(done.stderr.splitlines()) == 1


def test_delay_of_messages_with_a_header(world: Graph) -> None:
    publish(world, "/stamped", POSE, "{header: auto}")
    done = world.interrupted("ros2", "topic", "delay", "/stamped", after="\tmin", times=1)
    text = r"average delay: 0\.\d{3}\n\tmin: 0\.\d{3}s max: 0\.\d{3}s std dev: .*s window: \d+\n"
    assert re.match(text, done.stdout)
    assert (done.status, done.stderr) == (2, "")


def test_bandwidth(world: Graph) -> None:
    done = world.interrupted("ros2", "topic", "bw", "/chatter", after="\tMessage", times=1)
    lines = done.stdout.splitlines()
    assert lines[0] == "Subscribed to [/chatter]"
    assert re.fullmatch(r"1\d\d B/s from \d+ messages", lines[1])
    assert lines[2] == "\tMessage size mean: 16 B min: 16 B max: 16 B"


def test_the_parameters_of_a_node_are_described_dumped_and_loaded(
    world: Graph, tmp_path: Path
) -> None:
    assert world.ros2("param", "describe", "/world", "speed").stdout == (
        "Parameter name: speed\n  Type: double\n  Description: metres a second\n  Constraints:\n"
    )
    file = tmp_path / "world.yaml"
    file.write_text(world.ros2("param", "dump", "/world").stdout)
    assert file.read_text().startswith("/world:\n  ros__parameters:\n    list:\n    - 1\n    - 2\n")
    file.write_text("/**:\n  ros__parameters:\n    name: bob\n    sides: many\n")
    done = world.ros2("param", "load", "/world", str(file))
    assert done.stdout == "Set parameter name successful\n"
    assert done.stderr.startswith("Set parameter sides failed: Wrong parameter type")
    assert world.ros2("param", "get", "world", "name").stdout == "String value is: bob\n"
    assert world.ros2("param", "get", "--hide-type", "/world", "list").stdout == "[1, 2, 3]\n"
    listed = world.ros2("param", "list", "/world", "--param-type", "--filter", "^s.*d$").stdout
    assert listed == "  speed (type: double)\n"
    missing = world.ros2("param", "load", "/world", str(tmp_path / "none.yaml"))
    assert (missing.status, len(missing.stderr.splitlines())) == (1, 1)


def test_interfaces_are_listed_and_shown(world: Graph) -> None:
    assert world.ros2("interface", "package", "std_srvs").stdout == (
        "std_srvs/srv/Empty\nstd_srvs/srv/SetBool\nstd_srvs/srv/Trigger\n"
    )
    listed = world.ros2("interface", "list", "-s").stdout
    assert listed.startswith("Services:\n    ")
    assert "    std_srvs/srv/Trigger\n" in listed
    assert "Messages:" not in listed
    proto = ("interface", "proto", "std_srvs/srv/SetBool")
    assert world.ros2(*proto).stdout == '"data: false\n"\n'
    assert world.ros2(*proto, "--no-quotes").stdout == "data: false\n\n"
    comments = world.ros2("interface", "show", "--all-comments", "geometry_msgs/msg/Twist").stdout
    assert "\t# This represents a vector in free space.\n" in comments
    done = world.ros2("interface", "show", "Twist")
    assert (done.status, len(done.stderr.splitlines())) == (1, 1)


def test_a_managed_node_is_found_without_a_slash_too(world: Graph) -> None:
    listed = world.ros2("lifecycle", "list", "managed")
    assert listed == world.ros2("lifecycle", "list", "/managed")
    assert world.ros2("lifecycle", "get").stdout == "/managed: unconfigured [1]\n"
    done = world.ros2("lifecycle", "set", "managed", "configure")
    assert done == (0, "Transitioning successful\n", "")
    world.ros2("lifecycle", "set", "managed", "cleanup")


@pytest.mark.parametrize(
    ("typed", "found"),
    [
        ("ros2 inter", ["interface"]),
        ("ros2 topic ec", ["echo"]),
        ("ros2 topic echo /ch", ["/chatter"]),
        ("ros2 topic echo --once --field data /tu", ["/turtle1/cmd_vel"]),
        ("ros2 topic echo --fu", ["--full-length"]),
        ("ros2 topic echo --qos-reliability be", ["best_effort", "best_available"]),
        ("ros2 topic pub /turtle1/cmd_vel g", ["geometry_msgs/msg/Twist"]),
        ("ros2 node info /w", ["/world"]),
        ("ros2 service call /en", ["/enable"]),
        ("ros2 param get /world sp", ["speed"]),
        ("ros2 param describe /world speed na", ["name"]),
        ("ros2 interface show std_srvs/srv/Se", ["std_srvs/srv/SetBool"]),
        ("ros2 run rosidl_ad", ["rosidl_adapter"]),
        ("ros2 pkg prefix std_sr", ["std_srvs"]),
        ("ros2 wt", ["wtf"]),
        ("ros2 lifecycle n", ["nodes"]),
        ("ros2 lifecycle set /managed con", ["configure"]),
        ("ros2 lifecycle set /managed cle", []),
        ("ros2 lifecycle set /world con", []),
        ("ros2 bag pl", []),
    ],
)
def test_tab_completes(world: Graph, typed: str, found: list[str]) -> None:
    done = world.run("bash", "-c", COMPLETE, str(COMPLETION), *typed.split())
    assert done.stdout.split() == found
