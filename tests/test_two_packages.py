"""An assignment with nodes in two Python packages, which are built and run together."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.base.errors import AssignmentError
from grader.base.unheard import unheard
from grader.course.load import load_assignment
from grader.package.submission import take_in
from grader.report.model import CheckResult, Report
from grader.ros.distro import find_distro
from grader.sandbox.limits import Limits
from grader.verdict.checks.all import CHECKS
from grader.verdict.mark import grade
from grader.verdict.order import Order
from grader.verdict.static import evaluate_static

ASSIGNMENT = """\
schema: 2
id: relay
title: "Two packages"
package: sensing
nodes:
  source: {executable: source, target: sensing.source:main, file: source.py, name: source}
  relay: {package: relaying, executable: relay, target: relaying.relay:main, file: relay.py, name: relay}
runs:
  - name: together
    start: [{node: source}, {node: relay}]
    clock: {period: 0.1, ticks: 20}
checks:
  - {id: package.found, points: 1}
  - {id: relay.there, check: package.beside, points: 1, with: {package: relaying}}
  - {id: build.colcon, points: 1}
  - {id: run.starts, points: 1}
  - {id: run.spins, points: 1}
  - {id: run.stays, points: 1}
  - {id: source.says, check: topic.publishes, of: source, points: 1, with: {topic: /in, type: std_msgs/msg/Int32}}
  - {id: relay.hears, check: topic.subscribes, of: relay, points: 1, with: {topic: /in, type: std_msgs/msg/Int32}}
  - {id: relay.says, check: topic.values, of: relay, points: 1, with: {topic: /out, each: {data: 2}}}
  - {id: relay.type, check: topic.publishes, of: relay, points: 1, with: {topic: /out, type: std_msgs/msg/Int32}}
  - {id: relay.logs, check: log.matches, of: relay, points: 1, with: {text: got 1, at_least: 5}}
  - {id: relay.logger, check: log.logger, of: relay, points: 1, with: {text: "got {n}"}}
"""
NODE = """\
#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class {name}(Node):
    def __init__(self):
        super().__init__('{lower}')
        self.made = self.create_publisher(Int32, '{topic}', 10)
        {rest}

    def on_timer(self):
        self.made.publish(Int32(data=1))

    def on_number(self, number):
        self.get_logger().info(f'got {{number.data}}')
        self.made.publish(Int32(data=2 * number.data))


def main(args=None):
    rclpy.init(args=args)
    rclpy.spin({name}())
"""
MANIFEST = """\
<?xml version="1.0"?>
<package format="3">
  <name>{package}</name><version>0.0.0</version><description>A node</description>
  <maintainer email="a@b.example">a</maintainer><license>Apache-2.0</license>
  <exec_depend>rclpy</exec_depend><exec_depend>std_msgs</exec_depend>
  <export><build_type>ament_python</build_type></export>
</package>
"""
SETUP = """\
from setuptools import find_packages, setup

setup(
    name='{package}',
    version='0.0.0',
    packages=find_packages(),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/{package}']),
        ('share/{package}', ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    entry_points={{'console_scripts': ['{node} = {package}.{node}:main']}},
)
"""


def write_one(src: Path, package: str, node: str, code: str) -> None:
    texts = {
        "package.xml": MANIFEST.format(package=package),
        "setup.py": SETUP.format(package=package, node=node),
        "setup.cfg": f"[develop]\nscript_dir=$base/lib/{package}\n"
        f"[install]\ninstall_scripts=$base/lib/{package}\n",
        f"resource/{package}": "",
        f"{package}/__init__.py": "",
        f"{package}/{node}.py": code,
    }
    for path, text in texts.items():
        (src / package / path).parent.mkdir(parents=True, exist_ok=True)
        (src / package / path).write_text(text, encoding="utf-8")


SOURCE = NODE.format(
    name="Source", lower="source", topic="/in", rest="self.create_timer(0.2, self.on_timer)"
)
RELAY = NODE.format(
    name="Relay",
    lower="relay",
    topic="/out",
    rest="self.create_subscription(Int32, '/in', self.on_number, 10)",
)

IN_CALLBACK = "    def on_number(self, number):\n"
DIES_LATER = RELAY.replace(IN_CALLBACK, f"{IN_CALLBACK}        self.missing.append(number)\n")
DIES_AT_START = RELAY.replace("super().__init__('relay')", "super().__init__('relay' + 1)")


def marked(folder: Path, *, relay: str | None) -> Report:
    file = folder / "assignment.yaml"
    file.write_text(ASSIGNMENT, encoding="utf-8")
    src = folder / "ws/src"
    write_one(src, "sensing", "source", SOURCE)
    if relay is not None:
        write_one(src, "relaying", "relay", relay)
    assignment = load_assignment(file, known_checks=CHECKS)
    assert assignment.others == ("relaying",)
    order = Order(
        path=folder / "ws",
        assignment=assignment,
        distro=find_distro("jazzy"),
        sandbox="bubblewrap",
        limits=Limits().override({"build_seconds": 120}),  # two packages
    )
    return grade(order, unheard)


@pytest.mark.prefix
@pytest.mark.full
def test_two_packages_get_full_marks(tmp_path: Path) -> None:
    report = marked(tmp_path, relay=RELAY)
    assert {c.id: (c.status, c.actual) for c in report.checks if c.status != "passed"} == {}
    assert {node for run in report.runs for node in run.observed.nodes} == {"/source", "/relay"}


@pytest.mark.prefix
@pytest.mark.parametrize(
    ("relay", "failed"),
    [
        pytest.param(
            RELAY.replace("2 * number", "3 * number"),
            {"relay.says": "topic.wrong_value"},
            marks=pytest.mark.full,
        ),
        pytest.param(
            RELAY.replace("f'got", "f'Got"),
            {"relay.logs": "log.wrong_text", "relay.logger": "log.missing"},
            marks=pytest.mark.long,
        ),
        pytest.param(None, {"relay.there": "beside.missing"}, marks=pytest.mark.long),
        pytest.param(
            RELAY.replace("'/out'", "'/uot'"),
            {"relay.type": "topic.wrong_name"},
            marks=pytest.mark.long,
        ),
    ],
)
def test_a_mistake_in_the_second_package_is_found(
    relay: str | None, failed: dict[str, str], tmp_path: Path
) -> None:
    report = marked(tmp_path, relay=relay)
    found = {c.id: c for c in report.checks if c.status == "failed"}
    assert {c.id: c.mistakes[0].id for c in found.values()} == failed
    for check in found.values():
        assert check.where is None or check.where.file == "relaying/relaying/relay.py"
    logged = found.get("relay.logs")
    if logged is not None and logged.where is not None:
        text = (relay or "").splitlines()[(logged.where.line or 1) - 1]
        assert "get_logger" in text


OF_FILES = """\
  - {id: readme, check: files.exists, points: 1, with: {path: README.md}}
  - {id: relay.readme, check: files.exists, of: relay, points: 1, with: {path: README.md}}
  - {id: relay.limit, check: files.matches, of: relay, points: 1, with: {path: README.md, text: {contains: limit}}}
  - {id: relay.manifest, check: package.manifest, of: relay, points: 1}
  - {id: relay.marker, check: package.marker, of: relay, points: 1}
  - {id: relay.setup_cfg, check: package.setup_cfg, of: relay, points: 1}
  - {id: relay.depends, check: package.depends, of: relay, points: 1}
"""
RELAYS = [f"relay.{name}" for name in ("readme", "limit", "manifest", "marker", "setup_cfg")]


def from_files(folder: Path) -> dict[str, CheckResult]:
    """Return what the files alone show in `folder`/ws, with checks of both packages' files."""
    file = folder / "assignment.yaml"
    file.write_text(ASSIGNMENT + OF_FILES, encoding="utf-8")
    assignment = load_assignment(file, known_checks=CHECKS)
    taken = take_in(
        folder / "ws", package="sensing", node_file="source.py", others=assignment.others
    )
    return {result.id: result for result in evaluate_static(taken, assignment)}


def test_a_check_of_files_that_names_a_node_is_about_its_package(tmp_path: Path) -> None:
    src = tmp_path / "ws/src"
    write_one(src, "sensing", "source", SOURCE)
    write_one(src, "relaying", "relay", RELAY)
    (src / "sensing/README.md").write_text("no word of it", encoding="utf-8")
    found = from_files(tmp_path)
    assert {one: found[one].status for one in ("readme", *RELAYS, "relay.depends")} == {
        "readme": "passed",
        "relay.readme": "failed",
        "relay.limit": "skipped",
        **dict.fromkeys(("relay.manifest", "relay.marker", "relay.setup_cfg"), "passed"),
        "relay.depends": "passed",
    }
    (src / "sensing/README.md").unlink()
    (src / "relaying/README.md").write_text("The limit is 3.", encoding="utf-8")
    (src / "relaying/setup.cfg").unlink()
    found = from_files(tmp_path)
    failed = {name: one.where for name, one in found.items() if one.status == "failed"}
    assert set(failed) == {"readme", "relay.setup_cfg"}
    place = failed["relay.setup_cfg"]
    assert place is None or place.file == "relaying/setup.cfg"


def test_the_checks_of_a_package_that_is_not_there_are_skipped(tmp_path: Path) -> None:
    write_one(tmp_path / "ws/src", "sensing", "source", SOURCE)
    found = from_files(tmp_path)
    assert found["relay.there"].status == "failed"
    for name in RELAYS:
        assert (found[name].status, found[name].blocked_by) == ("skipped", "relay.there"), name


@pytest.mark.prefix
@pytest.mark.full
@pytest.mark.parametrize(
    ("relay", "check", "mistake", "line", "word"),
    [
        (DIES_LATER, "run.stays", "node.attribute_not_set", "self.missing", "by itself"),
        (DIES_AT_START, "run.starts", "node.str_plus_int", "super()", "on startup"),
    ],
    ids=["later", "at start"],
)
def test_a_second_program_that_dies_is_told(
    relay: str, check: str, mistake: str, line: str, word: str, tmp_path: Path
) -> None:
    report = marked(tmp_path, relay=relay)
    told = next(found for found in report.checks if found.status == "failed")
    assert (told.id, told.mistakes[0].id) == (check, mistake)
    assert told.actual.startswith("relay: ") and word in told.actual
    assert told.where is not None and told.where.file == "relaying/relaying/relay.py"
    assert line in relay.splitlines()[(told.where.line or 1) - 1]
    other = report.runs[0].others[0]
    assert (other.node, other.ended_by_itself, other.exit.status) == ("relay", True, 1)
    assert report.runs[0].observed.exit is not None
    assert "Traceback" in report.evidence.transcript.partition("^C")[0]


@pytest.mark.prefix
@pytest.mark.full
def test_a_second_program_that_never_spins_is_told(tmp_path: Path) -> None:
    report = marked(
        tmp_path, relay=RELAY.replace("rclpy.spin(Relay())", "n = Relay()\n    input()")
    )
    told = next(found for found in report.checks if found.status == "failed")
    assert (told.id, told.mistakes[0].id) == ("run.spins", "node.spin_missing")
    assert told.actual.startswith("relay: the node does not answer")
    assert told.where is not None and told.where.file == "relaying/relaying/relay.py"


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("package: relaying,", "package: Relaying,", "package must be"),
        ("package: relaying,", "pakage: relaying,", "did you mean 'package'"),
        ("[{node: source}, {node: relay}]", "[{node: relay}]", "must be in the package 'sensing'"),
    ],
)
def test_a_wrong_package_is_told_with_its_line(
    old: str, new: str, words: str, tmp_path: Path
) -> None:
    file = tmp_path / "assignment.yaml"
    file.write_text(ASSIGNMENT.replace(old, new), encoding="utf-8")
    line = ASSIGNMENT[: ASSIGNMENT.index(old)].count("\n") + 1
    with pytest.raises(AssignmentError, match=words) as told:
        load_assignment(file, known_checks=CHECKS)
    assert str(told.value).startswith(f"{file}:{line}:")
