"""What each world of a run offers: the source of its page in the documentation, and of defaults.

The worlds themselves are in `grader/run/in_probe`, which runs in the sandbox.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

BUMP = "bump"
"""The event that must not happen unless a check says otherwise."""


@dataclass(frozen=True)
class Offer:
    """A topic, a service or an action of a world: `use` is what it is for.

    `every` is how often (s) the world publishes the topic; 0 for what the world receives.
    """

    name: str
    type: str
    use: str
    every: float = 0.0


@dataclass(frozen=True, kw_only=True)
class World:
    """A world: `size` is the side (m) of its square field, whose corner is (0, 0).

    `first` is what moves in it from the beginning, at `start` (x and y in m, theta in rad), and
    what `turtle:` means if it is not given. `events` are those of `world.event`, with their fields.
    """

    about: str
    size: float
    first: str
    start: tuple[float, float, float]
    offers: tuple[Offer, ...]
    events: Mapping[str, str]


WORLDS: Mapping[str, World] = MappingProxyType(
    {
        "turtlesim": World(
            about="The turtles of ROS's turtlesim, without a window. More turtles can be spawned; "
            "each has the topics, services and the action of turtle1 under its own name.",
            size=499 / 45,
            first="turtle1",
            start=(499 / 90, 499 / 90, 0.0),
            offers=(
                Offer(
                    "/turtle1/cmd_vel",
                    "geometry_msgs/msg/Twist",
                    "velocity commands: linear.x (m/s) and angular.z (rad/s) hold for 1 s",
                ),
                Offer("/turtle1/pose", "turtlesim/msg/Pose", "published every 0.016 s", 0.016),
                Offer(
                    "/turtle1/color_sensor", "turtlesim/msg/Color", "published every 0.016 s", 0.016
                ),
                Offer("/turtle1/set_pen", "turtlesim/srv/SetPen", "changes what it draws with"),
                Offer(
                    "/turtle1/teleport_absolute",
                    "turtlesim/srv/TeleportAbsolute",
                    "puts it elsewhere",
                ),
                Offer(
                    "/turtle1/teleport_relative",
                    "turtlesim/srv/TeleportRelative",
                    "turns it, then puts it ahead",
                ),
                Offer(
                    "/turtle1/rotate_absolute",
                    "turtlesim/action/RotateAbsolute",
                    "turns it to an angle, at 1 rad/s",
                ),
                Offer("/spawn", "turtlesim/srv/Spawn", "adds a turtle"),
                Offer("/kill", "turtlesim/srv/Kill", "removes a turtle"),
                Offer("/clear", "std_srvs/srv/Empty", "clears the drawing"),
                Offer("/reset", "std_srvs/srv/Empty", "begins anew, with turtle1 alone"),
            ),
            events={
                "pen": "set_pen was called: `r`, `g`, `b`, `width`, `off`",
                "spawn": "a turtle was added with /spawn",
                "kill": "a turtle was removed with /kill",
                BUMP: "a turtle begins to touch the wall",
            },
        ),
        "robot": World(
            about="A round robot (radius 0.2 m) with two wheels and a laser scanner, in a room with "
            "a box from (5, 5) to (6, 6). It stops where it would run into something.",
            size=8.0,
            first="robot",
            start=(2.0, 2.0, 0.0),
            offers=(
                Offer(
                    "/cmd_vel",
                    "geometry_msgs/msg/Twist",
                    "velocity commands: linear.x (m/s) and angular.z (rad/s) hold for 1 s",
                ),
                Offer(
                    "/odom",
                    "nav_msgs/msg/Odometry",
                    "pose and velocity, published every 0.016 s; frame `odom`, child `base_link`",
                    0.016,
                ),
                Offer(
                    "/scan",
                    "sensor_msgs/msg/LaserScan",
                    "72 distances from the robot's centre, published every 0.08 s: `ranges[0]` is "
                    "straight ahead, the next is 5° further to the left (`angle_min` 0, "
                    "`angle_max` 6.196); `range_min` 0.05 m, `range_max` 12 m; reliable, a queue "
                    "of 10. The robot touches what is 0.2 m from its centre",
                    0.08,
                ),
            ),
            events={BUMP: "the robot begins to touch a wall or the box"},
        ),
    }
)


def is_of_world(world: str, topic: str) -> bool:
    """Whether a world publishes a topic: it says what came of the commands of the nodes."""
    offers = WORLDS[world].offers if world in WORLDS else ()
    return any(one.name == topic and one.every for one in offers)
