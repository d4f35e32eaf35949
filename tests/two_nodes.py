"""A package with two nodes, a talker and a listener, the assignment for it, and broken forms of it."""

from __future__ import annotations

from pathlib import Path

from grader.course.assignment import Assignment
from grader.course.load import load_assignment
from grader.verdict.checks.all import CHECKS

ASSIGNMENT = """\
schema: 2
id: talking
title: "A talker and a listener"
package: my_talking
nodes:
  talker: {executable: talker, target: my_talking.talker:main, file: talker.py, name: talker}
  listener: {executable: listener, target: my_talking.listener:main, file: listener.py, name: listener}
runs:
  - name: chat
    start: [{node: talker}, {node: listener}]
    clock: {period: 0.25, ticks: 12}
  - name: alone
    start: [{node: listener}]
    clock: {period: 0.25, ticks: 8}
    do:
      - {name: hello, at: 1.0, publish: {topic: /chatter, type: std_msgs/msg/String, values: {data: hello}}}
checks:
  - {id: package.found, points: 1}
  - {id: source.node_file, points: 1}
  - {id: source.exec_bit, points: 1}
  - {id: source.shebang, points: 1}
  - {id: build.colcon, points: 1}
ENTRIES
  - {id: run.starts, points: 1}
  - {id: run.spins, points: 1}
  - {id: run.node_name, points: 1}
  - {id: run.stays, points: 1}
  - {id: talker.publishes, check: topic.publishes, of: talker, points: 1, with: {topic: /chatter, type: std_msgs/msg/String}}
  - {id: talker.period, check: topic.period, of: talker, points: 1, with: {topic: /chatter, period: 0.5}}
  - {id: listener.subscribes, check: topic.subscribes, of: listener, run: alone, points: 1, with: {topic: /chatter, type: std_msgs/msg/String}}
  - {id: listener.logs, check: log.matches, of: listener, run: alone, after: hello, points: 1, with: {text: I heard hello}}
  - {id: listener.hears, check: log.matches, of: listener, run: chat, points: 1, with: {text: {contains: Hello}, at_least: 3}}
  - {id: run.interrupt, points: 1}
"""
ENTRIES = """\
  - {id: entry_point.mapping, points: 1}
  - {id: entry_point.executable, points: 1}
"""
TALKER = """\
#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Talker(Node):
    def __init__(self):
        super().__init__('talker')
        self.count = 0
        self.made = self.create_publisher(String, 'chatter', 10)
        self.create_timer(0.5, self.on_timer)

    def on_timer(self):
        self.made.publish(String(data=f'Hello {self.count}'))
        self.get_logger().info(f'Publishing {self.count}')
        self.count += 1


def main(args=None):
    rclpy.init(args=args)
    rclpy.spin(Talker())


if __name__ == '__main__':
    main()
"""
LISTENER = """\
#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Listener(Node):
    def __init__(self):
        super().__init__('listener')
        self.create_subscription(String, 'chatter', self.on_text, 10)

    def on_text(self, text):
        self.get_logger().info(f'I heard {text.data}')


def main(args=None):
    rclpy.init(args=args)
    rclpy.spin(Listener())


if __name__ == '__main__':
    main()
"""
MANIFEST = """\
<?xml version="1.0"?>
<package format="3">
  <name>my_talking</name><version>0.0.0</version><description>Two nodes</description>
  <maintainer email="a@b.example">a</maintainer><license>Apache-2.0</license>
  <exec_depend>rclpy</exec_depend><exec_depend>std_msgs</exec_depend>
  <export><build_type>ament_python</build_type></export>
</package>
"""
SETUP = """\
from setuptools import find_packages, setup

setup(
    name='my_talking',
    version='0.0.0',
    packages=find_packages(),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/my_talking']),
        ('share/my_talking', ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    entry_points={
        'console_scripts': [
            'talker = my_talking.talker:main',
            'listener = my_talking.listener:main',
        ],
    },
)
"""
TEXTS = {
    "package.xml": MANIFEST,
    "setup.py": SETUP,
    "setup.cfg": "[develop]\nscript_dir=$base/lib/my_talking\n"
    "[install]\ninstall_scripts=$base/lib/my_talking\n",
    "resource/my_talking": "",
    "my_talking/__init__.py": "",
    "my_talking/talker.py": TALKER,
    "my_talking/listener.py": LISTENER,
}
NODES = ("my_talking/talker.py", "my_talking/listener.py")
ENTRY = "            'listener = my_talking.listener:main',\n"


def assignment(folder: Path, *, entries: bool = True) -> Assignment:
    """Return the assignment, with the checks of entry points or without."""
    file = folder / "assignment.yaml"
    text = ASSIGNMENT.replace("ENTRIES\n", ENTRIES if entries else "")
    file.write_text(text, encoding="utf-8")
    return load_assignment(file, known_checks=CHECKS)


def write(folder: Path, *edits: tuple[str, str, str], plain: tuple[str, ...] = ()) -> Path:
    """Write the package with edits (file, old, new); the files in `plain` are not executable."""
    root = folder / "my_talking"
    texts = dict(TEXTS)
    for file, old, new in edits:
        assert old in texts[file]
        texts[file] = texts[file].replace(old, new)
    for name, text in texts.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        path.chmod(0o755 if name in NODES and name not in plain else 0o644)
    return root
