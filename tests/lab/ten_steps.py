"""The tutorial's ten steps, typed literally; the commands are read from the lesson."""

from __future__ import annotations

import re
from pathlib import Path

from lab.guide.lesson import read_lesson
from tests import processes
from tests.lab.screen import Lab

PACKAGE = "~/ros2_ws/src/my_robot_controller"
NODE = """\
#!/usr/bin/env python3
import rclpy
from rclpy.node import Node


class MyFirstNode(Node):

    def __init__(self):
        super().__init__('my_first_node')
        self.counter_ = 0
        self.create_timer(1.0, self.timer_callback)

    def timer_callback(self):
        self.get_logger().info('Hello time: ' + str(self.counter_))
        self.counter_ += 1


def main(args=None):
    rclpy.init(args=args)
    node = MyFirstNode()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    node.destroy_node()
    rclpy.try_shutdown()


if __name__ == '__main__':
    main()
"""


def commands(distro: str) -> dict[int, list[str]]:
    """Return the lesson's commands, by step."""
    lesson = read_lesson(processes.ROOT / "lab/course/hello_time/lesson.md", distro=distro)
    return {
        step.number: [
            line
            for block in re.findall(r"^```bash\n(.*?)^```$", step.text, re.MULTILINE | re.DOTALL)
            for line in block.splitlines()
        ]
        for step in lesson.steps
    }


def follow(lab: Lab, distro: str = "jazzy") -> None:
    """Follow the ten steps; raise AssertionError or pexpect's TIMEOUT if the lab fails."""
    steps = commands(distro)
    for number in (1, 2, 3):
        for line in steps[number]:
            output = lab.type(line)
            assert lab.status() == 0, output
    assert "creating folder ./my_robot_controller" in output
    assert "Summary: 1 package finished" in [lab.type(line) for line in steps[4]][-1]
    assert "Next: touch" in lab.type("guide")
    for line in (*steps[5], *steps[6]):
        output = lab.type(line)
        assert lab.status() == 0, output
    lab.write("my_first_node.py", NODE)
    assert "Next: Add this line to console_scripts" in lab.type("guide")
    entry = "'test_node = my_robot_controller.my_first_node:main',"
    lab.type(f"""sed -i "s/'console_scripts': \\[/&{entry}/" {PACKAGE}/setup.py""")
    assert "Summary: 1 package finished" in [lab.type(line) for line in steps[8]][-1]
    run_and_stop(lab, steps[9], distro)
    listed = [line[:3] for line in lab.type("guide list").splitlines()]
    assert listed[:11] == ["[ ]"] + ["[x]"] * 9 + ["[>]"]  # the turtle of step 0 was left out


def run_and_stop(lab: Lab, lines: list[str], distro: str = "jazzy") -> None:
    """Source and run, check the count, and press Ctrl+C.

    From kilted on, `ros2 run` sends the node a second Ctrl+C, which may cut its clean-up short.
    """
    *first, run = lines
    for line in first:
        lab.type(line)
    lab.screen.sendline(run)
    for count in range(3):
        lab.screen.expect_exact(f"[my_first_node]: Hello time: {count}")
    output = lab.interrupt()
    assert lab.status() in ((0,) if distro == "jazzy" else (0, 254)), output


def owners(workspace: Path) -> set[int]:
    """Return the user ids that own a workspace and its content."""
    return {path.lstat().st_uid for path in (workspace, *workspace.rglob("*"))}
