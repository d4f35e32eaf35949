"""Every recording of the real `ros2 lifecycle`, replayed in its order against our command."""

from __future__ import annotations

import json
import re
import signal
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from .graph import Done, Graph

pytestmark = [pytest.mark.prefix, pytest.mark.full]

RECORDING: dict[str, Any] = json.loads(
    (Path(__file__).parents[1] / "recordings" / "ros2cli-jazzy-lifecycle.json").read_text()
)
CASES: list[dict[str, Any]] = RECORDING["cases"]
BY_NAME = {case["name"]: case for case in CASES}
# the recorded nodes, which say when they are there
NODE = """\
import rclpy
spin = rclpy.spin
def tell(node):
    print("ready", flush=True)
    spin(node)
rclpy.spin = tell
from lab_pkg import life, nodes
{}()
"""
TIME = re.compile(r"\[\d+\.\d+\]")


class Replayed(NamedTuple):
    done: dict[str, Done]  # by the name of the case
    said: str  # what the managed node wrote


@pytest.fixture(scope="module")
def replayed(jazzy_prefix: Path, tmp_path_factory: pytest.TempPathFactory) -> Replayed:
    folder = tmp_path_factory.mktemp("lifecycle")
    for name, text in RECORDING["package"].items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    graph = Graph(jazzy_prefix, folder)
    try:
        camera = graph.start("python3", "-c", NODE.format("life.main"))
        graph.start("python3", "-c", NODE.format("nodes.talker"))
        done = {case["name"]: graph.run(*case["argv"]) for case in CASES}
        camera.send_signal(signal.SIGINT)
        return Replayed(done, camera.communicate(timeout=60)[1])
    finally:
        graph.stop()


def test_every_recording_is_replayed() -> None:
    assert (len(CASES), len(BY_NAME)) == (45, 45)


@pytest.mark.parametrize("name", BY_NAME)
def test_output_and_status_are_the_recorded_ones(replayed: Replayed, name: str) -> None:
    case = BY_NAME[name]
    assert replayed.done[name] == Done(case["status"], case["stdout"], case["stderr"])


def test_the_node_made_the_recorded_transitions(replayed: Replayed) -> None:
    recorded = "".join(case.get("the node said", "") for case in CASES)
    assert TIME.sub("[<TIME>]", replayed.said) == recorded
