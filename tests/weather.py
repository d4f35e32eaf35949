"""A small other course: a package `weather_station` that counts readings from 1, every 0.5 s."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from grader.course.assignment import Assignment
from grader.course.load import load_assignment
from grader.package.edit.tree import Edit, apply_all, write_tree
from grader.package.intake.model import SourceFile
from grader.package.submission import Submission, take_in

NAME = "weather_station"
NODE = f"{NAME}/station.py"
SETUP = "setup.py"
MARKER = f"resource/{NAME}"
ENTRY = "'read_out = weather_station.station:begin',"
LOG = "self.get_logger().info(f'Reading {self.reading}')"
TIMER = "        self.create_timer(0.5, self.take)\n"
STEP = "        self.reading += 1\n"

CHECKS = {
    **dict.fromkeys(("package.found", "package.manifest", "package.marker"), 5),
    **dict.fromkeys(("package.setup_cfg", "source.node_file", "source.exec_bit"), 5),
    **dict.fromkeys(("source.shebang", "build.colcon", "entry_point.executable"), 5),
    **dict.fromkeys(("entry_point.mapping", "run.starts", "run.node_name"), 10),
    **dict.fromkeys(("run.output", "run.logger", "run.period", "run.interrupt"), 10),
}
ASSIGNMENT = f"""\
schema: 1
id: readings
title: "A weather station that counts its readings"
package: {NAME}
node_file: station.py
node_name: station
executable: read_out
target: weather_station.station:begin
output: {{text: "Reading {{n}}", start: 1, step: 1, period: 0.5, ticks: 4}}
checks:
{"".join(f"  - {{id: {check}, points: {points}}}{chr(10)}" for check, points in CHECKS.items())}"""
FULL_MARKS = sum(CHECKS.values())

LESSON = """\
# Readings

A station takes a reading every half second.

## 1. What a station is

Read this, and go on.

## 2. Make the package
<!-- done: package -->

```bash
source /opt/ros/jazzy/setup.bash
```

[Packages](https://docs.ros.org/en/jazzy/Concepts.html) have a manifest.

## 3. Write the station
<!-- done: node -->

It counts.

## 4. Name it
<!-- done: entry_point -->

In setup.py.
"""
KOREAN = LESSON.replace("Write the station", "관측소 쓰기")

FILES = {
    "package.xml": f"""\
<?xml version="1.0"?>
<package format="3">
  <name>{NAME}</name>
  <version>0.0.0</version>
  <description>Readings of a station</description>
  <maintainer email="kim@example.org">Kim</maintainer>
  <license>Apache-2.0</license>
  <depend>rclpy</depend>
  <export>
    <build_type>ament_python</build_type>
  </export>
</package>
""",
    "setup.cfg": f"""\
[develop]
script_dir=$base/lib/{NAME}
[install]
install_scripts=$base/lib/{NAME}
""",
    SETUP: f"""\
from setuptools import find_packages, setup

package_name = '{NAME}'

setup(
    name=package_name,
    version='0.0.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    install_requires=['setuptools'],
    entry_points={{
        'console_scripts': [
            {ENTRY}
        ],
    }},
)
""",
    MARKER: "",
    f"{NAME}/__init__.py": "",
    NODE: f"""\
#!/usr/bin/env python3
import rclpy
from rclpy.node import Node


class Station(Node):
    def __init__(self):
        super().__init__('station')
        self.reading = 1
{TIMER}
    def take(self):
        {LOG}
{STEP}

def begin(args=None):
    rclpy.init(args=args)
    station = Station()
    try:
        rclpy.spin(station)
    except KeyboardInterrupt:
        pass
    station.destroy_node()
    rclpy.try_shutdown()


if __name__ == '__main__':
    begin()
""",
}
TREE = {
    path: SourceFile(path, "file", 0o755 if path == NODE else 0o644, text.encode())
    for path, text in FILES.items()
}


def write_course(folder: Path, *others: str) -> Path:
    """Write the course, with further lessons of the given ids, and return its folder."""
    for lesson in ("readings", *others):
        place = folder / "course" / lesson
        place.mkdir(parents=True)
        (place / "assignment.yaml").write_text(
            ASSIGNMENT.replace("id: readings", f"id: {lesson}"), encoding="utf-8"
        )
        (place / "lesson.md").write_text(LESSON, encoding="utf-8")
        (place / "lesson.ko.md").write_text(KOREAN, encoding="utf-8")
    return folder / "course"


def write_package(folder: Path, *edits: Edit) -> Path:
    """Write the right package, with these edits, and return its folder."""
    root = folder / NAME
    write_tree(apply_all(edits, TREE), root)
    return root


@cache
def assignment() -> Assignment:
    """Return the course's assignment."""
    with TemporaryDirectory() as folder:
        return load_assignment(write_course(Path(folder)) / "readings" / "assignment.yaml")


def taken(folder: Path, *edits: Edit) -> Submission:
    """Return the submission of the right package with these edits."""
    return take_in(write_package(folder, *edits), package=NAME, node_file="station.py")
