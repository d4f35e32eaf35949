"""The world "robot": a robot with two wheels and a laser scanner in a square room with a box.

It shows what a world is: a class with `NAME`, `STEP`, `now`, `collect`, `advance`, `sent`, `spawn`,
`move`, `unnamed`, `steps` and `events`. `Drive` has the update rule alone, without ROS. The probe runs
it in ROS time, under the prefix's Python: it imports nothing of the grader. What it offers to an
assignment stands in `grader/course/worlds.py`.

- `/cmd_vel` (geometry_msgs/msg/Twist): linear.x and angular.z hold for one second.
- `/odom` (nav_msgs/msg/Odometry): pose and velocity, at each step.
- `/scan` (sensor_msgs/msg/LaserScan): the distances to the walls, at every fifth step.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

STEP = 16_000_000  # ns between two updates
DT = 0.016  # s
SIZE = 8.0  # m, of the square room
RADIUS = 0.2  # m, of the robot
BOX = (5.0, 5.0, 6.0, 6.0)  # m: x and y of two corners
COMMAND_SECONDS = 1.0  # after which a velocity command is over
BEAMS = 72
NEAREST, FARTHEST = 0.05, 12.0  # m, of the scanner
SCAN_STEPS = 5  # between two scans
QUEUE = 10
SECOND = 1_000_000_000


def _sides(low_x: float, low_y: float, high_x: float, high_y: float) -> list[tuple[float, ...]]:
    """Return the four sides of a rectangle: x and y of both ends."""
    return [
        (low_x, low_y, high_x, low_y),
        (high_x, low_y, high_x, high_y),
        (high_x, high_y, low_x, high_y),
        (low_x, high_y, low_x, low_y),
    ]


WALLS = [*_sides(0.0, 0.0, SIZE, SIZE), *_sides(*BOX)]


def distance(x: float, y: float, angle: float, walls: Iterable[tuple[float, ...]] = WALLS) -> float:
    """Return how far (m) it is from a place to the nearest wall in a direction; inf for none."""
    across, along = math.cos(angle), math.sin(angle)
    best = math.inf
    for ax, ay, bx, by in walls:
        wx, wy = bx - ax, by - ay
        turned = across * wy - along * wx
        if abs(turned) < 1e-12:
            continue
        far = ((ax - x) * wy - (ay - y) * wx) / turned
        part = ((ax - x) * along - (ay - y) * across) / turned
        if far >= 0 and 0 <= part <= 1:
            best = min(best, far)
    return best


def is_free(x: float, y: float) -> bool:
    """Whether the robot fits at a place."""
    inside = RADIUS < x < SIZE - RADIUS and RADIUS < y < SIZE - RADIUS
    near_x = max(BOX[0] - x, 0.0, x - BOX[2])
    near_y = max(BOX[1] - y, 0.0, y - BOX[3])
    return inside and math.hypot(near_x, near_y) > RADIUS


@dataclass
class Drive:
    """The robot: its pose (m, rad) and the velocity that holds (m/s, rad/s)."""

    x: float = 2.0
    y: float = 2.0
    theta: float = 0.0
    forward: float = 0.0
    turning: float = 0.0
    commanded: int = 0

    def command(self, forward: float, turning: float, at: int) -> None:
        """Take a velocity command that arrived at `at` (ns)."""
        self.forward, self.turning, self.commanded = forward, turning, at

    def step(self, now: int) -> bool:
        """Make the update of an instant (ns); return whether the robot runs into something."""
        if now - self.commanded > COMMAND_SECONDS * SECOND:
            self.forward = self.turning = 0.0
        turned = self.theta + self.turning * DT
        self.theta = math.atan2(math.sin(turned), math.cos(turned))
        x = self.x + math.cos(self.theta) * self.forward * DT
        y = self.y + math.sin(self.theta) * self.forward * DT
        if not is_free(x, y):
            return True
        self.x, self.y = x, y
        return False

    def scan(self) -> list[float]:
        """Return the distances (m) around, beginning straight ahead and turning left."""
        angles = (self.theta + 2 * math.pi * n / BEAMS for n in range(BEAMS))
        return [distance(self.x, self.y, angle) for angle in angles]


class World:
    """The node `robot`."""

    NAME = "robot"
    STEP = STEP

    def __init__(self, node: Any, group: Any) -> None:
        """Offer the topics on a node; the subscription is in a callback group for `collect`."""
        from geometry_msgs.msg import Twist  # noqa: PLC0415 - of the prefix
        from nav_msgs.msg import Odometry  # noqa: PLC0415
        from sensor_msgs.msg import LaserScan  # noqa: PLC0415

        self.node, self.drive, self.now = node, Drive(), 0
        self._odometry, self._scan = Odometry, LaserScan
        self._commands = node.create_subscription(
            Twist, "cmd_vel", lambda _: None, QUEUE, callback_group=group
        )
        self._odom = node.create_publisher(Odometry, "odom", QUEUE)
        self._scans = node.create_publisher(LaserScan, "scan", QUEUE)
        self._given: list[tuple[float, float]] = []
        self._count = 0
        self._touches = False
        self.sent: list[Any] = []  # the publishers of what the last update sent
        self.steps: list[tuple[str, float, float, float]] = []
        self.events: list[dict[str, Any]] = []

    def given(self, topic: str, message: Any) -> bool:
        """Take a velocity command without ROS, for the next `collect`; return whether it is one."""
        is_command = topic == "/cmd_vel" and type(message) is self._commands.msg_type
        if is_command:
            self._given.append((message.linear.x, message.angular.z))
        return is_command

    def collect(self, at: int) -> None:
        """Take the velocity commands that have arrived; they hold from the next update on."""
        given, self._given = self._given, []
        for command in given:
            self.drive.command(*command, at)
        for _ in range(QUEUE * 100):
            with self._commands.handle:
                taken = self._commands.handle.take_message(self._commands.msg_type, False)
            if taken is None:
                return
            self.drive.command(taken[0].linear.x, taken[0].angular.z, at)

    def advance(self, to: int) -> None:
        """Make the updates until `to` (ns) and publish."""
        while self.now + STEP <= to:
            self.now += STEP
            touches = self.drive.step(self.now)
            if touches and not self._touches:
                self.events.append({"kind": "bump", "turtle": self.NAME})
            self._touches = touches
            self.steps.append((self.NAME, self.drive.x, self.drive.y, self.drive.theta))
            self._publish()

    def unnamed(self, how: str) -> str:
        """Return what is put elsewhere if the assignment does not name it."""
        del how
        return self.NAME

    def spawn(self, name: str, x: float, y: float, theta: float) -> bool:
        """Return False: there is one robot."""
        del name, x, y, theta
        return False

    def move(self, name: str, x: float, y: float, theta: float) -> bool:
        """Put the robot elsewhere; return whether it fits there."""
        if name != self.NAME or not is_free(x, y):
            return False
        self.drive.x, self.drive.y, self.drive.theta = x, y, theta
        return True

    def _publish(self) -> None:
        drive = self.drive
        odom = self._odometry()
        self._stamp(odom.header, "odom")
        odom.child_frame_id = "base_link"
        odom.pose.pose.position.x, odom.pose.pose.position.y = drive.x, drive.y
        odom.pose.pose.orientation.z = math.sin(drive.theta / 2)
        odom.pose.pose.orientation.w = math.cos(drive.theta / 2)
        odom.twist.twist.linear.x = drive.forward
        odom.twist.twist.angular.z = drive.turning
        self._odom.publish(odom)
        self.sent = [self._odom]
        self._count += 1
        if self._count % SCAN_STEPS:
            return
        scan = self._scan()
        self._stamp(scan.header, "base_link")
        scan.angle_min, scan.angle_max = 0.0, 2 * math.pi * (BEAMS - 1) / BEAMS
        scan.angle_increment = 2 * math.pi / BEAMS
        scan.scan_time = SCAN_STEPS * DT
        scan.range_min, scan.range_max = NEAREST, FARTHEST
        scan.ranges = drive.scan()
        self._scans.publish(scan)
        self.sent.append(self._scans)

    def _stamp(self, header: Any, frame: str) -> None:
        header.frame_id = frame
        header.stamp.sec, header.stamp.nanosec = divmod(self.now, SECOND)
