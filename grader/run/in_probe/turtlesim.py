"""The world "turtlesim": the turtles and the field of ROS's turtlesim, without a window.

The update rule and the interfaces are those of the package `turtlesim` (see ../shared facts in
docs/worlds.md). `Field` has the rule alone, without ROS; `World` is the node `turtlesim` that
offers it. The probe runs it in ROS time, the lab on the wall clock. It runs under the prefix's
Python and imports nothing of the grader.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any

PACKAGES = ("turtlesim", "turtlesim_msgs")  # with the interfaces, up to jazzy and later
STEP = 16_000_000  # ns between two updates
DT = 0.016  # s by which an update moves a turtle
SIZE = 499 / 45  # m, of the square field
COMMAND_SECONDS = 1.0  # after which a velocity command is over
TURN_SPEED = 1.0  # rad/s of rotate_absolute
TURN_DONE = 0.02  # rad
BACKGROUND = {"r": 69, "g": 86, "b": 255}
QUEUE = 7  # commands that a turtle keeps
SECOND = 1_000_000_000


def within_pi(angle: float) -> float:
    """Return an angle (rad) in the range from -pi to pi."""
    return angle - 2 * math.pi * math.floor((angle + math.pi) / (2 * math.pi))


@dataclass
class Pen:
    """What a turtle draws with; `width` in pixels."""

    r: int = 179
    g: int = 184
    b: int = 255
    width: int = 3
    on: bool = True


@dataclass
class Turtle:
    """A turtle: its pose (m, rad), the velocity that holds (m/s, rad/s), and its pen.

    `commanded` is when the velocity was commanded, in ns. `goal` is the angle that it turns to.
    """

    name: str
    x: float = SIZE / 2
    y: float = SIZE / 2
    theta: float = 0.0
    forward: float = 0.0
    sideways: float = 0.0
    turning: float = 0.0
    commanded: int = 0
    goal: float | None = None
    turned: float = 0.0
    pen: Pen = field(default_factory=Pen)
    hits: int = 0
    touches: bool = False
    bumps: bool = False  # whether it began to touch the wall with the last update
    put: bool = False  # whether it was put elsewhere since the last update

    def place(self, x: float, y: float, theta: float) -> None:
        """Put it elsewhere."""
        self.x, self.y, self.theta, self.put = x, y, within_pi(theta), True

    def command(self, forward: float, sideways: float, turning: float, at: int) -> None:
        """Take a velocity command that arrived at `at` (ns)."""
        self.forward, self.sideways, self.turning, self.commanded = forward, sideways, turning, at

    def step(self, now: int, *, holonomic: bool = False) -> str:
        """Make the update of an instant (ns); return a warning, "" if there is none."""
        if now - self.commanded > COMMAND_SECONDS * SECOND:
            self.forward = self.sideways = self.turning = 0.0
        if self.goal is not None:
            left = within_pi(self.goal - self.theta)
            done = abs(left) < TURN_DONE
            self.turning = 0.0 if done else math.copysign(TURN_SPEED, left)
            self.forward = self.sideways = 0.0
            self.commanded = now
        self.theta = within_pi(self.theta + self.turning * DT)
        side = self.sideways if holonomic else 0.0
        x = self.x + (math.cos(self.theta) * self.forward - math.sin(self.theta) * side) * DT
        y = self.y + (math.sin(self.theta) * self.forward + math.cos(self.theta) * side) * DT
        self.x, self.y = min(max(x, 0.0), SIZE), min(max(y, 0.0), SIZE)
        touched, self.touches = self.touches, (self.x, self.y) != (x, y)
        self.bumps = self.touches and not touched
        if not self.touches:
            return ""
        self.hits += 1
        return f"Oh no! I hit the wall! (Clamping from [x={x:f}, y={y:f}])"

    @property
    def speed(self) -> float:
        """The speed in m/s that the pose shows."""
        return math.hypot(self.forward, self.sideways)


class Field:
    """All turtles, at an instant of the clock that drives them."""

    def __init__(self, *, holonomic: bool = False) -> None:
        self.holonomic = holonomic
        self.turtles: dict[str, Turtle] = {"turtle1": Turtle("turtle1")}
        self.now = 0  # ns
        self._made = 1

    def advance(self, to: int, after_step: Callable[[], None], warn: Callable[[str], None]) -> None:
        """Make all updates until the instant `to` (ns); call `after_step` after each."""
        while self.now + STEP <= to:
            self.now += STEP
            for turtle in self.turtles.values():
                warning = turtle.step(self.now, holonomic=self.holonomic)
                if warning:
                    warn(warning)
            after_step()

    def new_name(self) -> str:
        """Return the next name that no turtle has."""
        while True:
            self._made += 1
            name = f"turtle{self._made}"
            if name not in self.turtles:
                return name

    def spawn(self, name: str, x: float, y: float, theta: float) -> bool:
        """Add a turtle; return whether there was none of that name."""
        if name in self.turtles:
            return False
        self.turtles[name] = Turtle(name, x, y, theta)
        return True

    def reset(self) -> None:
        """Begin anew: one turtle in the middle."""
        self.turtles = {"turtle1": Turtle("turtle1", put=True)}
        self._made = 1


class World:
    """The node `turtlesim` on a field.

    Messages of `cmd_vel` are taken when `collect` is called, services when the node is spun.
    """

    NAME = "turtlesim"
    STEP = STEP

    def __init__(self, node: Any, group: Any) -> None:
        """Offer the interfaces on a node; subscriptions are in a callback group for `collect`.

        Where ROS has no package turtlesim, its turtles only take velocity commands.
        """
        from geometry_msgs.msg import Twist  # noqa: PLC0415 - of the prefix
        from std_srvs.srv import Empty  # noqa: PLC0415

        self.node, self._group = node, group
        self._messages, self._services, self._actions = _interfaces()
        self._twist = Twist
        self.field = Field()
        self._ends: dict[str, list[Any]] = {}
        self._commands: dict[str, Any] = {}
        self._poses: dict[str, Any] = {}
        self._colors: dict[str, Any] = {}
        self._goals: dict[str, tuple[Any, Any]] = {}
        self._given: list[tuple[str, tuple[float, float, float]]] = []
        self.steps: list[tuple[str, float, float, float, bool]] = []
        self.events: list[dict[str, Any]] = []
        for letter, value in BACKGROUND.items():
            node.declare_parameter(f"background_{letter}", value, _byte(letter))
        node.declare_parameter("holonomic", False)
        node.create_service(Empty, "clear", lambda _, answer: answer)
        node.create_service(Empty, "reset", self._reset)
        if self._services is not None:
            node.create_service(self._services.Spawn, "spawn", self._spawn)
            node.create_service(self._services.Kill, "kill", self._kill)
        self._add("turtle1")

    @property
    def now(self) -> int:
        """The instant (ns) of the last update."""
        return self.field.now

    @property
    def sent(self) -> list[Any]:
        """The publishers of what each update sends."""
        return [*self._poses.values(), *self._colors.values()]

    def given(self, topic: str, message: Any) -> bool:
        """Take a velocity command without ROS, for the next `collect`; return whether it is one."""
        name = topic.removeprefix("/").removesuffix("/cmd_vel")
        is_command = name in self._commands and topic == f"/{name}/cmd_vel"
        if is_command and type(message) is self._twist:
            twist = (message.linear.x, message.linear.y, message.angular.z)
            self._given.append((name, twist))
            return True
        return False

    def _command(self, name: str, twist: tuple[float, float, float], at: int) -> None:
        turtle = self.field.turtles[name]
        if name in self._goals and turtle.goal is not None:
            self._abort(name, "Velocity command received during rotation goal")
        turtle.command(*twist, at)

    def collect(self, at: int) -> None:
        """Take the velocity commands that have arrived; they hold from the next update on."""
        given, self._given = self._given, []
        for name, command in given:
            if name in self._commands:
                self._command(name, command, at)
        for name, subscription in list(self._commands.items()):
            for _ in range(QUEUE * 100):
                with subscription.handle:
                    taken = subscription.handle.take_message(subscription.msg_type, False)
                if taken is None:
                    break
                twist = taken[0]
                self._command(name, (twist.linear.x, twist.linear.y, twist.angular.z), at)

    def advance(self, to: int) -> None:
        """Make the updates until `to` (ns) and publish the poses."""
        self.field.holonomic = bool(self.node.get_parameter("holonomic").value)
        self.field.advance(to, self._publish, self.node.get_logger().warning)

    def spawn(self, name: str, x: float, y: float, theta: float) -> bool:
        """Add a turtle; return whether there was none of that name."""
        if not self.field.spawn(name, x, y, theta):
            return False
        self._add(name)
        return True

    def unnamed(self, how: str) -> str:
        """Return the name of what is put into the world if the assignment does not name it."""
        return self.field.new_name() if how == "spawn" else "turtle1"

    def move(self, name: str, x: float, y: float, theta: float) -> bool:
        """Put a turtle elsewhere; return whether it is there."""
        turtle = self.field.turtles.get(name)
        if turtle is None:
            return False
        turtle.place(x, y, theta)
        return True

    def _publish(self) -> None:
        for name, turtle in self.field.turtles.items():
            self.steps.append((name, turtle.x, turtle.y, turtle.theta, turtle.put))
            turtle.put = False
            if turtle.bumps:
                self._event("bump", name)
            if self._messages is None:
                continue
            pose = self._messages.Pose(
                x=turtle.x,
                y=turtle.y,
                theta=turtle.theta,
                linear_velocity=turtle.speed,
                angular_velocity=turtle.turning,
            )
            self._poses[name].publish(pose)
            self._colors[name].publish(self._messages.Color(**BACKGROUND))
            self._turn(name, turtle)

    def _turn(self, name: str, turtle: Turtle) -> None:
        """Report on a turtle's goal, and end it if the turtle looks the right way."""
        if name not in self._goals or turtle.goal is None:
            return
        handle, future = self._goals[name]
        left = within_pi(turtle.goal - turtle.theta)
        if handle.is_cancel_requested or not handle.is_active:
            turtle.goal, turtle.turning = None, 0.0
            future.set_result("canceled")
        elif abs(left) < TURN_DONE:
            turtle.goal, turtle.turning = None, 0.0
            future.set_result("done")
        else:
            handle.publish_feedback(self._actions.RotateAbsolute.Feedback(remaining=left))

    def _add(self, name: str) -> None:
        from rclpy.action import ActionServer, CancelResponse  # noqa: PLC0415 - of the prefix

        node, services = self.node, self._services
        self._commands[name] = node.create_subscription(
            self._twist, f"{name}/cmd_vel", lambda _: None, QUEUE, callback_group=self._group
        )
        if self._messages is None:
            return
        self._poses[name] = node.create_publisher(self._messages.Pose, f"{name}/pose", 10)
        self._colors[name] = node.create_publisher(self._messages.Color, f"{name}/color_sensor", 10)

        def pen(request: Any, answer: Any) -> Any:
            self.field.turtles[name].pen = Pen(
                request.r, request.g, request.b, request.width, not request.off
            )
            colour = {"r": request.r, "g": request.g, "b": request.b}
            self._event("pen", name, **colour, width=request.width, off=request.off)
            return answer

        def absolute(request: Any, answer: Any) -> Any:
            self.field.turtles[name].place(request.x, request.y, request.theta)
            return answer

        def relative(request: Any, answer: Any) -> Any:
            turtle = self.field.turtles[name]
            theta = within_pi(turtle.theta + request.angular)
            x = turtle.x + math.cos(theta) * request.linear
            y = turtle.y + math.sin(theta) * request.linear
            turtle.place(x, y, theta)
            return answer

        async def rotate(handle: Any) -> Any:
            from rclpy.task import Future  # noqa: PLC0415 - of the prefix

            turtle = self.field.turtles[name]
            if name in self._goals:
                self._abort(name, "Rotation goal received before a previous goal finished")
            began, future = turtle.theta, Future()
            turtle.goal = within_pi(handle.request.theta)
            self._goals[name] = (handle, future)
            ended = await future
            if self._goals.get(name, (None,))[0] is handle:
                del self._goals[name]
            result = self._actions.RotateAbsolute.Result(delta=within_pi(began - turtle.theta))
            if ended == "done":
                handle.succeed()
            elif ended == "canceled":
                handle.canceled()
            else:
                handle.abort()
            return result

        self._ends[name] = [
            node.create_service(services.SetPen, f"{name}/set_pen", pen),
            node.create_service(services.TeleportAbsolute, f"{name}/teleport_absolute", absolute),
            node.create_service(services.TeleportRelative, f"{name}/teleport_relative", relative),
            ActionServer(
                node,
                self._actions.RotateAbsolute,
                f"{name}/rotate_absolute",
                rotate,
                cancel_callback=lambda _: CancelResponse.ACCEPT,
            ),
        ]

    def _abort(self, name: str, why: str) -> None:
        handle, future = self._goals.pop(name)
        self.field.turtles[name].goal = None
        self.node.get_logger().warning(f"{why}. Aborting goal")
        if handle.is_active and not future.done():
            future.set_result("aborted")

    def _spawn(self, request: Any, answer: Any) -> Any:
        name = request.name or self.field.new_name()
        if not self.spawn(name, request.x, request.y, request.theta):
            self.node.get_logger().error(f"A turtle named [{name}] already exists")
            return answer
        place = f"x=[{request.x:f}], y=[{request.y:f}], theta=[{request.theta:f}]"
        self.node.get_logger().info(f"Spawning turtle [{name}] at {place}")
        self._event("spawn", name)
        answer.name = name
        return answer

    def _kill(self, request: Any, answer: Any) -> Any:
        if request.name not in self.field.turtles:
            what = f"Tried to kill turtle [{request.name}], which does not exist"
            self.node.get_logger().error(what)
            return answer
        del self.field.turtles[request.name]
        self._remove(request.name)
        self._event("kill", request.name)
        return answer

    def _remove(self, name: str) -> None:
        self.node.destroy_publisher(self._poses.pop(name))
        self.node.destroy_publisher(self._colors.pop(name))
        self.node.destroy_subscription(self._commands.pop(name))
        *services, action = self._ends.pop(name)
        for service in services:
            self.node.destroy_service(service)
        action.destroy()

    def _reset(self, _: Any, answer: Any) -> Any:
        self.node.get_logger().info("Resetting turtlesim.")
        for name in [name for name in self.field.turtles if name != "turtle1"]:
            self._remove(name)
        self.field.reset()
        return answer

    def _event(self, kind: str, turtle: str, **more: Any) -> None:
        self.events.append({"kind": kind, "turtle": turtle, **more})


def _interfaces() -> tuple[Any, ...]:
    """Return turtlesim's messages, services and actions; None if ROS does not have them."""
    for package in PACKAGES:
        try:
            return tuple(import_module(f"{package}.{kind}") for kind in ("msg", "srv", "action"))
        except ImportError:
            continue
    return None, None, None


def _byte(letter: str) -> Any:
    from rcl_interfaces.msg import IntegerRange, ParameterDescriptor  # noqa: PLC0415 - of the prefix

    colour = {"r": "red", "g": "green", "b": "blue"}[letter]
    return ParameterDescriptor(
        description=f"Amount of {colour} in the background",
        integer_range=[IntegerRange(from_value=0, to_value=255, step=1)],
    )
