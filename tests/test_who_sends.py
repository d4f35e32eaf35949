"""What is judged was sent by the node that is judged: right packages with several nodes, and others."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from grader.course.load import load_assignment
from grader.report.model import Report
from grader.verdict.checks.all import CHECKS
from tests.processes import ROOT
from tests.scenario_kinds import ASSIGNMENT, NODE
from tests.senders import CIRCLE, HOSTILE, RIGHT, Edited
from tests.test_scenarios import judged, marked

pytestmark = [pytest.mark.prefix, pytest.mark.full]
DEPENDS = ("std_msgs", "rcl_interfaces")  # what the edits import besides the solutions


def each(packages: tuple[Edited, ...]) -> list[object]:
    return [
        pytest.param(one, id=one.name, marks=[] if one.in_ci else pytest.mark.long)
        for one in packages
    ]


def verdict(package: Edited, folder: Path, *, distro: str = "jazzy") -> Report:
    """Return the report of an edited solution."""
    copy = folder / "handed_in"
    shutil.copytree(ROOT / "grader" / "keys" / package.lesson / "solution", copy)
    (node,) = copy.rglob(f"{package.lesson}.py")
    text = node.read_text(encoding="utf-8")
    for old, new in package.edits:
        assert old in text, old
        text = text.replace(old, new)
    compile(text, str(node), "exec")
    node.write_text(text, encoding="utf-8")
    (manifest,) = copy.rglob("package.xml")
    xml = manifest.read_text(encoding="utf-8")
    more = [name for name in DEPENDS if f"from {name}" in text and f">{name}<" not in xml]
    lines = "".join(f"  <depend>{name}</depend>\n" for name in more)
    first = "  <depend>rclpy</depend>\n"
    assert first in xml
    manifest.write_text(xml.replace(first, first + lines), encoding="utf-8")
    file = ROOT / "lab" / "course" / package.lesson / "assignment.yaml"
    return marked(copy, file, [], distro=distro)


@pytest.mark.parametrize("package", each(RIGHT))
def test_a_right_package_with_other_nodes_loses_nothing(package: Edited, tmp_path: Path) -> None:
    report = verdict(package, tmp_path)
    assert {c.id: c.actual for c in report.checks if c.status != "passed"} == {}
    assert report.score == report.max_score


@pytest.mark.parametrize("package", each(HOSTILE))
def test_another_node_earns_nothing_for_the_judged_one(package: Edited, tmp_path: Path) -> None:
    report = verdict(package, tmp_path)
    failed = {c.id: c.mistakes[0].id for c in report.checks if c.status == "failed"}
    assert package.fails.items() <= failed.items(), failed
    if {"drive.publishes", "run.node_name"} & package.fails.keys():
        status = {c.id: c.status for c in report.checks}
        of_topic = ("drive.publishes", "drive.period", "drive.speed", "drive.tighter", "drive.path")
        assert [name for name in of_topic if status[name] == "passed"] == []


@pytest.mark.long
def test_of_two_nodes_of_one_name_none_is_judged(tmp_path: Path) -> None:
    """The first check that needs to know them apart says so, if none asks for the name."""
    nameless = "\n".join(line for line in ASSIGNMENT.splitlines() if "graph.node_name" not in line)
    twice = ("    node = Doubler()\n", "    node = Doubler()\n    twin = Node('doubler')\n")
    assert twice[0] in NODE and nameless != ASSIGNMENT
    report = judged(nameless, NODE.replace(*twice), tmp_path)
    mistakes = [m.id for c in report.checks for m in c.mistakes]
    assert mistakes.count("graph.node_twice") == 1
    of_ends = ("topic.", "service.", "action.", "parameter.", "graph.connects")
    file = tmp_path / "lesson" / "assignment.yaml"
    kinds = {use.id: use.kind for use in load_assignment(file, known_checks=CHECKS).checks}
    passed = {kinds[c.id] for c in report.checks if c.status == "passed"}
    assert {kind for kind in passed if kind.startswith(of_ends)} <= {"topic.silent"}


def test_the_other_node_is_named(tmp_path: Path) -> None:
    (hidden,) = [one for one in HOSTILE if one.name == "a_hidden_node"]
    report = verdict(hidden, tmp_path)
    (publishes,) = [one for one in report.checks if one.id == "drive.publishes"]
    assert "/hidden/other" in str(publishes.actual)
    assert "/draw_circle" in str(publishes.expected)
    assert publishes.mistakes[0].params == {"node": "/hidden/other"}


@pytest.mark.long
def test_kilted_tells_the_sender_too(tmp_path: Path) -> None:
    (hidden,) = [one for one in HOSTILE if one.name == "a_hidden_node"]
    report = verdict(hidden, tmp_path, distro="kilted")
    failed = {c.id: c.mistakes[0].id for c in report.checks if c.status == "failed"}
    assert failed == {"drive.publishes": "topic.foreign_sender"}


@pytest.mark.long
def test_another_node_with_the_same_action(tmp_path: Path) -> None:
    other = (
        "    node = Doubler()\n    other = rclpy.create_node('other')\n"
        "    server = ActionServer(other, RotateAbsolute, '/turn', node.on_goal)\n"
    )
    report = judged(ASSIGNMENT, NODE.replace("    node = Doubler()\n", other), tmp_path)
    failed = {c.id: c.mistakes[0].id for c in report.checks if c.status == "failed"}
    assert failed["turn"] == "action.foreign_server"
    status = {c.id: c.status for c in report.checks}
    names = ("small", "excessive", "feedback", "result", "cancel")
    assert [name for name in names if status[f"turn.{name}"] == "passed"] == []


def test_there_are_twenty_right_and_ten_hostile_packages() -> None:
    assert len({one.name for one in RIGHT}) >= 20
    assert len({one.name for one in HOSTILE}) >= 10
    assert {one.lesson for one in RIGHT} > {CIRCLE}
