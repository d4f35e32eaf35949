"""Every recording of the real ros2cli 0.32.2 on the graph, replayed against our command.

The recorded order is kept: `param set` changes the world.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from .graph import WORLD, Done, Graph

pytestmark = [pytest.mark.prefix, pytest.mark.full]

RECORDING = Path(__file__).parents[1] / "recordings" / "ros2cli-jazzy-graph.json"
CASES: list[dict[str, Any]] = json.loads(RECORDING.read_text())["cases"]
BY_NAME = {case["name"]: case for case in CASES}
# commands that went on until Ctrl+C: the line that is awaited, and how often
INTERRUPTED = {
    "topic echo until Ctrl+C": ("data: hello", 3),
    "topic hz": ("\tmin", 2),
    "topic pub until Ctrl+C": ("publishing #", 2),
    "topic pub waits for nobody": ("Waiting", 2),
    "service call of unknown": ("waiting", 1),
}
# what differs on purpose has a test of its own below
DIFFERENT = {
    "daemon status": "there is no daemon",
    "interface packages": "the recording's prefix had other packages",
    "topic delay": "the real command had not discovered the topic yet and warned",
    "topic pub bad yaml": "the real command shows a traceback",
}
EQUAL = [name for name in BY_NAME if name not in INTERRUPTED and name not in DIFFERENT]
OWN_NODE = re.compile(r"/_ros2cli_\w+")  # the daemon's node there, the command's here
HZ = re.compile(
    r"(average rate: \d+\.\d{3}\n"
    r"\tmin: \d+\.\d{3}s max: \d+\.\d{3}s std dev: \d+\.\d{5}s window: \d+\n)+"
)


@pytest.fixture(scope="module")
def world(jazzy_prefix: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Graph]:
    graph = Graph(jazzy_prefix, tmp_path_factory.mktemp("world"))
    graph.start("python3", str(WORLD))
    yield graph
    graph.stop()


def replay(world: Graph, name: str) -> Done:
    return world.run(*BY_NAME[name]["argv"])


def until_interrupted(world: Graph, name: str) -> Done:
    line, times = INTERRUPTED[name]
    return world.interrupted(*BY_NAME[name]["argv"], after=line, times=times)


def normalised(world: Graph, text: str) -> str:
    return OWN_NODE.sub("/<own node>", text.replace(str(world.prefix), "<PREFIX>"))


def test_every_recording_is_replayed() -> None:
    assert len(BY_NAME) == len(CASES)
    assert sorted(BY_NAME) == sorted([*EQUAL, *INTERRUPTED, *DIFFERENT])


@pytest.mark.parametrize("name", EQUAL)
def test_output_and_status_are_the_recorded_ones(world: Graph, name: str) -> None:
    case = BY_NAME[name]
    done = replay(world, name)
    assert normalised(world, done.stdout) == normalised(world, case["stdout"])
    assert normalised(world, done.stderr) == normalised(world, case["stderr"])
    assert done.status == case["status"]


@pytest.mark.parametrize("name", [name for name in INTERRUPTED if name != "topic hz"])
def test_ctrl_c_ends_as_recorded(world: Graph, name: str) -> None:
    """How many samples were printed is chance: one output begins with the other."""
    case = BY_NAME[name]
    done = until_interrupted(world, name)
    shorter, longer = sorted((done.stdout, case["stdout"]), key=len)
    assert longer.startswith(shorter)
    assert (done.status, done.stderr) == (case["status"], case["stderr"])


def test_hz_prints_the_recorded_lines_with_other_figures(world: Graph) -> None:
    case = BY_NAME["topic hz"]
    done = until_interrupted(world, "topic hz")
    assert HZ.fullmatch(case["stdout"])
    assert HZ.fullmatch(done.stdout)
    assert [int(n) for n in re.findall(r"window: (\d+)", done.stdout)][1] > 11
    assert (done.status, done.stderr) == (case["status"], case["stderr"])


def test_different_daemon_status_says_that_there_is_none(world: Graph) -> None:
    for verb in ("status", "start", "stop"):
        done = world.ros2("daemon", verb)
        assert (done.status, done.stderr) == (0, "")
        assert re.fullmatch(r".*daemon.*this ros2 has none.*\n|There is no daemon.*\n", done.stdout)


def test_different_interface_packages_are_those_of_this_prefix(world: Graph) -> None:
    case = BY_NAME["interface packages"]
    done = replay(world, "interface packages")
    index = world.prefix / "share" / "ament_index" / "resource_index" / "rosidl_interfaces"
    assert done.stdout.splitlines() == sorted(path.name for path in index.iterdir())
    assert set(case["stdout"].split()) - set(done.stdout.split()) == {"test_msgs"}
    assert (done.status, done.stderr) == (case["status"], case["stderr"])


def test_different_delay_does_not_warn_of_a_topic_that_is_there(world: Graph) -> None:
    case = BY_NAME["topic delay"]
    done = replay(world, "topic delay")
    assert case["stdout"] == "WARNING: topic [/chatter] does not appear to be published yet\n"
    assert (done.status, done.stdout, done.stderr) == (case["status"], "", case["stderr"])


def test_different_bad_yaml_is_one_line_without_a_traceback(world: Graph) -> None:
    case = BY_NAME["topic pub bad yaml"]
    done = replay(world, "topic pub bad yaml")
    assert (done.status, done.stdout) == (case["status"], case["stdout"])
    assert len(done.stderr.splitlines()) == 1
    assert "line 1, column 18" in case["stderr"]
    assert "character 18 of line 1" in done.stderr
    assert "expected ',' or '}'" in done.stderr
