"""What of Python and of ROS cannot tell a program that it is marked; anything else is run plainly."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.package.intake.model import SourceFile
from grader.package.source.telling import CANNOT, COULD, could_tell, telling
from grader.sandbox.base import Sandbox
from tests.processes import ROOT

NODE = """\
import math
import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.executors import ExternalShutdownException


class Driver(Node):
    def __init__(self):
        super().__init__('driver')
        self.declare_parameter('radius', 2.0)
        self.angle = math.pi
        self.publisher_ = self.create_publisher(Twist, 'cmd_vel', 10)
        self.timer = self.create_timer(0.5, self.tick)

    def tick(self):
        message = Twist()
        message.linear.x = 2.0 / self.get_parameter('radius').value
        HERE
        self.publisher_.publish(message)
        self.get_logger().info(f'{message.linear.x:.2f} is {message.angular.z}')


def main(args=None):
    rclpy.init(args=args)
    try:
        rclpy.spin(Driver())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


if __name__ == '__main__':
    main()
"""


def told(here: str = "pass", *, imports: str = "") -> str:
    """Return what the package could tell by, with a statement in its callback."""
    text = imports + NODE.replace("HERE", here)
    files = [
        SourceFile("robot/driver.py", "file", 0o755, text.encode(), ""),
        SourceFile("setup.py", "file", 0o644, b"import os\n", ""),
    ]
    found = telling(files)
    assert could_tell(files) == bool(found)
    return " ".join(one.what for one in found)


@pytest.mark.parametrize(
    "here",
    [
        "self.count = len([1, 2]) + 1",
        "message.angular.z = max(0.0, min(1.0, message.linear.x))",
        "self.timer.cancel()",
        "self.destroy_timer(self.timer)",
        "print('moving'.upper(), flush=True)",
    ],
)
def test_what_a_first_node_uses_cannot_tell(here: str) -> None:
    assert told(here) == ""


@pytest.mark.parametrize(
    ("here", "by"),
    [
        ("self.get_clock().ros_time_is_active", "ros_time_is_active"),
        ("now = self.get_clock()", "self.get_clock"),
        ("self._clock", "self._clock"),
        ("self.get_parameter('use_sim_time').value", "use_sim_time"),
        ("self.get_parameter('use_' + 'sim_time').value", "get_parameter"),
        ("self.get_parameters_by_prefix('')", "self.get_parameters_by_prefix"),
        ("getattr(self, 'x')", "getattr"),
        ("vars(self)", "vars"),
        ("open('/etc/hostname')", "open"),
        ("self.count_publishers('/x')", "self.count_publishers"),
        ("self.publisher_.get_subscription_count()", "get_subscription_count"),
        ("self.timer.time_since_last_call()", "time_since_last_call"),
        ("self.__class__", "self.__class__"),
        ("'{0._clock}'.format(self)", "{0._clock}"),
        ("message.header.stamp.sec", "sec"),
        ("rclpy.spin_once(self)", "rclpy.spin_once"),
        ("rclpy.clock.Clock()", "rclpy.clock"),
        ("eval('1')", "eval"),
    ],
)
def test_what_could_tell_is_named(here: str, by: str) -> None:
    assert by in told(here)


@pytest.mark.parametrize(
    "imports",
    [
        *("import time\n", "import os\n", "import threading\n", "from sys import argv\n"),
        *("from rclpy.clock import Clock\n", "from rosgraph_msgs.msg import Clock\n"),
        *("import subprocess as math2\n", "from importlib import import_module\n"),
        "from rcl_interfaces.msg import ParameterEvent\n",
    ],
)
def test_a_module_that_is_not_in_the_table_could_tell(imports: str) -> None:
    assert told(imports=imports) != ""


@pytest.mark.parametrize(
    ("value", "tells"),
    [
        *(("sys.argv", ""), ("args or sys.argv", ""), ("sys.argv if args is None else args", "")),
        ("args if sys.argv else None", "sys.argv"),
    ],
)
def test_arguments_that_are_passed_on_cannot_tell(value: str, tells: str) -> None:
    text = NODE.replace("HERE", "pass").replace("args=args", f"args={value}")
    files = [SourceFile("robot/driver.py", "file", 0o755, f"import sys\n{text}".encode(), "")]
    assert [one.what for one in telling(files)] == ([tells] if tells else [])


def test_what_a_module_is_used_for_is_told_with_its_line() -> None:
    text = "import os\n" + NODE.replace("HERE", "x = os.environ.get('HOME')")
    (found,) = telling([SourceFile("robot/driver.py", "file", 0o755, text.encode(), "")])
    assert found.what == "os.environ"
    assert found.line is not None
    assert "os.environ" in text.splitlines()[found.line - 1]
    assert found.path == "robot/driver.py"


@pytest.mark.parametrize("imports", ["from robot.parts import wheel\n", "from .parts import a\n"])
def test_the_packages_own_modules_are_read_themselves(imports: str) -> None:
    assert told(imports=imports) == ""


def test_no_solution_of_the_course_could_tell(subtests: pytest.Subtests) -> None:
    """(They are what most packages of a class are like: none of these costs a second run.)"""
    for solution in sorted((ROOT / "grader" / "keys").glob("*/solution")):
        with subtests.test(solution.parent.name):
            assert not could_tell(_files(solution))


def _files(folder: Path) -> list[SourceFile]:
    paths = sorted(folder.rglob("*.py"))
    return [SourceFile(p.name, "file", 0o644, p.read_bytes(), "") for p in paths]


LISTED = """
import rclpy.action.client as c, rclpy.action.server as s, rclpy.impl.rcutils_logger as log
import rclpy.clock, rclpy.context, rclpy.executors, rclpy.guard_condition, rclpy.lifecycle, rclpy.task
kinds = [rclpy.node.Node, rclpy.lifecycle.LifecycleNode, rclpy.clock.ROSClock, rclpy.time.Time,
         rclpy.context.Context, rclpy.executors.MultiThreadedExecutor, rclpy.timer.Timer,
         rclpy.timer.Rate, rclpy.publisher.Publisher, rclpy.subscription.Subscription,
         rclpy.client.Client, rclpy.service.Service, rclpy.parameter.Parameter, s.ActionServer,
         c.ActionClient, s.ServerGoalHandle, c.ClientGoalHandle, rclpy.duration.Duration,
         rclpy.guard_condition.GuardCondition, rclpy.task.Future, rclpy.qos.QoSProfile,
         log.RcutilsLogger]
print(*sorted({name for kind in kinds for name in dir(kind) if name[0] != '_'}))
"""


@pytest.mark.prefix
def test_every_public_name_of_rclpys_objects_is_in_one_of_the_tables(sandbox: Sandbox) -> None:
    outcome = sandbox.run(
        ["bash", "-c", f'. "{sandbox.ros_path}/setup.bash"; exec python3 -c "$0"', LISTED],
        seconds=60,
    )
    names = set(outcome.output.decode().split())
    assert len(names) > 200
    assert names - CANNOT - COULD == set()
    assert set() == CANNOT & COULD
