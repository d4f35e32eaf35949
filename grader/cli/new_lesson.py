"""The files of a new lesson: an assignment that can be marked at once, to be changed step by step."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from grader.base.errors import UsageError
from grader.ros.ros2_command.pkg.manifest import PackageDescription, manifest
from grader.ros.ros2_command.pkg.python_package import populate_ament_python

ASSIGNMENT = """\
# The requirements and the points of this exercise. `grader` validates this file.
# All checks and their parameters: docs/checks.md; all keys: docs/assignments.md.
schema: 2
id: {lesson}
title: "{title}"                  # what students read
package: {package}
nodes:
  main: {{executable: {lesson}, target: "{package}.{lesson}:main", file: {lesson}.py, name: {lesson}}}
runs:
  - name: counts
    start: [{{node: main}}]
    clock: {{period: 0.25, ticks: 40}}    # seconds of ROS time; it divides the timers' periods
checks:
  - {{id: package.found, points: 5}}
  - {{id: package.manifest, points: 5}}
  - {{id: package.marker, points: 5}}
  - {{id: package.setup_cfg, points: 5}}
  - {{id: source.node_file, points: 5}}
  - {{id: build.colcon, points: 5}}
  - {{id: entry_point.mapping, points: 5}}
  - {{id: entry_point.executable, points: 5}}
  - {{id: run.starts, points: 5}}
  - {{id: run.spins, points: 5}}
  - {{id: run.node_name, points: 5}}
  - {{id: run.stays, points: 5}}
  - {{id: counts.publishes, check: topic.publishes, points: 15, with: {{topic: /count, type: std_msgs/msg/Int32}}}}
  - {{id: counts.period, check: topic.period, points: 15, with: {{topic: /count, period: 0.5}}}}
  - {{id: counts.values, check: topic.values, points: 5, with: {{topic: /count, each: {{data: {{from: 0, step: 1}}}}}}}}
  - {{id: run.interrupt, points: 5}}
"""

NODE = '''\
#!/usr/bin/env python3
"""Publishes a number twice a second."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Counter(Node):
    """Counts from 0 on."""

    def __init__(self):
        super().__init__('{lesson}')
        self.number_ = 0
        self.publisher_ = self.create_publisher(Int32, '/count', 10)
        self.create_timer(0.5, self.on_timer)

    def on_timer(self):
        """Publish the number."""
        self.publisher_.publish(Int32(data=self.number_))
        self.number_ += 1


def main(args=None):
    """Run the node until Ctrl+C."""
    rclpy.init(args=args)
    node = Counter()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
'''

MUTANTS = """\
# What students get wrong in this lesson; `grader validate` marks each. The form: docs/assignments.md.
schema: 1
mutants:
  - name: "publish never called"
    check: counts.publishes
    mistake: topic.never_published
    edits:
      - {{replace: {package}/{lesson}.py, old: "        self.publisher_.publish(Int32(data=self.number_))\\n", new: ""}}
  - name: "topic misspelt"
    check: counts.publishes
    mistake: topic.wrong_name
    edits:
      - {{replace: {package}/{lesson}.py, old: "'/count'", new: "'/cuont'"}}
  - name: "four times a second"
    check: counts.period
    mistake: topic.wrong_period
    edits:
      - {{replace: {package}/{lesson}.py, old: "create_timer(0.5", new: "create_timer(0.25"}}
  - name: "counts in twos"
    check: counts.values
    mistake: topic.wrong_value
    edits:
      - {{replace: {package}/{lesson}.py, old: "self.number_ += 1", new: "self.number_ += 2"}}
equivalent:                       # automatic mutants that are right: the name, and why
  - mutant: "package.xml dependency that nobody has"
    why: "nothing is missing where rclpy is installed; package.depends asks for the line"
  - mutant: "setup.py without name"
    why: "setuptools takes the name of the only package"
  - mutant: "setup.py misspells name"
    why: "setuptools warns of the option and takes the name of the only package"
  - mutant: "setup.py list without 'test'"
    why: "there is no folder test that could be taken for a package"
  - mutant: "setup.py list without ('share/' + package_name, ['package.xml'])"
    why: "colcon-ros installs package.xml itself, with a warning"
  - mutant: "setup.py list without 'package.xml'"
    why: "colcon-ros installs package.xml itself, with a warning"
  - mutant: "setup.py misspells 'test'"
    why: "there is no folder test that could be taken for a package"
  - mutant: "setup.py misspells 'share/'"
    why: "package.xml is installed elsewhere, and by colcon-ros where it belongs"
  - mutant: "drop main()"
    why: "ros2 run calls main through the entry point: the guard is for running the file itself"
  - mutant: "twice main()"
    why: "ros2 run calls main through the entry point: the guard is for running the file itself"
  - mutant: "misspell main"
    why: "ros2 run calls main through the entry point: the guard is for running the file itself"
  - mutant: "no brackets main()"
    why: "ros2 run calls main through the entry point: the guard is for running the file itself"
  - mutant: "guard misspelt"
    why: "ros2 run calls main through the entry point: the guard is for running the file itself"
  - mutant: "drop node.destroy_node()"
    why: "the process ends here anyway, and with it the node and the context"
  - mutant: "no brackets node.destroy_node()"
    why: "the process ends here anyway, and with it the node and the context"
  - mutant: "drop rclpy.try_shutdown()"
    why: "the process ends here anyway, and with it the node and the context"
  - mutant: "no brackets rclpy.try_shutdown()"
    why: "the process ends here anyway, and with it the node and the context"
  - mutant: "twice rclpy.spin(node)"
    why: "the second is never reached: Ctrl+C leaves the try"
  - mutant: "twice node.destroy_node()"
    why: "a node that is destroyed already is left alone"
  - mutant: "twice rclpy.try_shutdown()"
    why: "it does nothing where the context is shut down already"
  - mutant: "except KeyboardInterrupt lost"
    why: "the node ends with KeyboardInterrupt's traceback, as the tutorial's readers see it: accepted"
  - mutant: "number 10 is 11"
    why: "the depth of a publisher's queue does not matter on one machine"
  - mutant: "number 10 is 9"
    why: "the depth of a publisher's queue does not matter on one machine"
  - mutant: "twice node = Counter()"
    why: "only the node that is spun has its timer called"
  - mutant: "twice super().__init__('{lesson}')"
    why: "the second makes the node anew before anything is in it"
  - mutant: "twice self.number_ = 0"
    why: "it says the same twice"
  - mutant: "twice self.publisher_ = self.create_publisher(Int32, '/count', 10)"
    why: "only the second publisher is used, and the first one is silent"
  - mutant: "swap self.number_ = 0 / self.publisher_ = self.create_publisher(Int32, '/count', 10)"
    why: "neither needs the other"
  - mutant: "swap self.publisher_ = self.create_publisher(Int32, '/count', 10) / self.create_timer(0.5, self.on_timer)"
    why: "the timer's first call comes a period later, when the publisher is there"
"""

LESSON = """\
# {title}

At the end of this lesson you have a node that publishes a number twice a second.

## 1. Open a terminal with ROS
<!-- done: terminal -->

```bash
source /opt/ros/jazzy/setup.bash
```

## 2. Create a package
<!-- done: package -->

```bash
cd ~/ros2_ws/src
ros2 pkg create --build-type ament_python {package} --dependencies rclpy std_msgs
```

## 3. Write the node
<!-- done: node_file -->

Its file is `{package}/{package}/{lesson}.py`.

## 4. Choose the name to run it by
<!-- done: entry_point -->

```python
'{lesson} = {package}.{lesson}:main',
```

## 5. Build and run
<!-- done: executable -->

```bash
cd ~/ros2_ws
colcon build --symlink-install
source install/local_setup.bash
ros2 run {package} {lesson}
```
"""

STARTER = """\
# Your packages go here

This folder is `~/ros2_ws/src`. Create the package `{package}` here, and submit its folder.
"""


def write_lesson(lesson: str, package: str, title: str, course: Path, keys: Path) -> list[Path]:
    """Write the files of a lesson and return their paths. Raises UsageError if a folder exists."""
    folders = (course / lesson, keys / lesson)
    for folder in folders:
        if folder.exists():
            raise UsageError(
                f"{folder} exists: nothing was written",
                remedy="Choose another name, or move that folder away.",
            )
    try:
        return list(_written(lesson, package, title, *folders))
    except OSError as error:
        raise UsageError(f"cannot write {error.filename}: {error.strerror}") from None


def _written(lesson: str, package: str, title: str, course: Path, keys: Path) -> Iterator[Path]:
    solution = keys / "solution" / package
    texts = {
        course / "assignment.yaml": ASSIGNMENT,
        course / "lesson.md": LESSON,
        course / "starter" / "src" / "README.md": STARTER,
        keys / "mutants.yaml": MUTANTS,
        solution / package / f"{lesson}.py": NODE,
    }
    _package(lesson, package, title, solution)
    for path, text in texts.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text.format(lesson=lesson, package=package, title=title), encoding="utf-8")
        yield path
    (solution / package / f"{lesson}.py").chmod(0o755)


def _package(lesson: str, package: str, title: str, folder: Path) -> None:
    described = PackageDescription(
        name=package,
        format=3,
        description=title,
        maintainer="student",
        email="student@todo.todo",
        license="Apache-2.0",
        build_type="ament_python",
        dependencies=("rclpy", "std_msgs"),
        node_name=lesson,
        library_name=None,
        kilted=False,
    )
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text(manifest(described), encoding="utf-8")
    populate_ament_python(described, str(folder))
