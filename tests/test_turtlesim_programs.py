"""turtlesim's programs on the wheels: the real `ros2 run` on a terminal, driven and listened to."""

from __future__ import annotations

import contextlib
import json
import math
import os
import re
import shlex
import signal
import subprocess
import termios
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pexpect
import pytest

from grader.ros import interfaces, turtlesim_executables
from grader.ros.distro import find_distro
from grader.ros.prefix import Ros
from grader.sandbox.proof import proven_ros
from tests.domains import new_domain

SECONDS = 30.0
MOST_POSES, POSES_BETWEEN = 2_000, 60
MIDDLE = 499 / 45 / 2
RIGHT, LEFT, UP = "\x1b[C", "\x1b[D", "\x1b[A"
NODE = """
import importlib, json, sys
import rclpy
from rclpy.node import Node
package = importlib.util.find_spec("turtlesim_msgs") and "turtlesim_msgs" or "turtlesim"
msg, srv, action = (importlib.import_module(f"{package}.{k}") for k in ("msg", "srv", "action"))
from geometry_msgs.msg import Twist
from std_srvs.srv import Empty
rclpy.init(args=sys.argv)
node = Node("tester")
def call(kind, name, /, **fields):
    client = node.create_client(kind, name)
    assert client.wait_for_service(20), name
    future = client.call_async(kind.Request(**fields))
    rclpy.spin_until_future_complete(node, future, timeout_sec=20)
    return future.result()
def pose_of(turtle, until=lambda pose: True):
    got = []
    subscription = node.create_subscription(msg.Pose, f"{turtle}/pose", got.append, 10)
    while not got or not until(got[-1]):
        rclpy.spin_once(node, timeout_sec=20)
    node.destroy_subscription(subscription)
    return got[-1]
def say(**values):
    print(json.dumps(values), flush=True)
"""
WATCH = """
def heard(pose):
    say(x=pose.x, y=pose.y, theta=pose.theta)
node.create_subscription(msg.Pose, "turtle1/pose", heard, 10)
rclpy.spin(node)
"""

pytestmark = [pytest.mark.prefix, pytest.mark.full]
Pose = dict[str, float]


class Terminals:
    """Terminals in which a prefix is sourced, in a ROS domain of their own."""

    def __init__(self, prefix: Path, folder: Path) -> None:
        self._setup = shlex.quote(str(prefix / "setup.bash"))
        self._folder = folder
        self._open: list[pexpect.spawn[str]] = []
        domain = {"ROS_DOMAIN_ID": new_domain(), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
        self._env = {**os.environ, **domain, "ROS_LOG_DIR": str(folder / "log")}

    def words(self, command: str) -> list[str]:
        return ["bash", "-c", f". {self._setup} && exec {command}"]

    def run(self, command: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            self.words(command),
            env=self._env,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=SECONDS * 2,
            check=False,
        )

    def open(self, command: str) -> pexpect.spawn[str]:
        program, *words = self.words(command)
        terminal = pexpect.spawn(program, words, env=self._env, encoding="utf-8", timeout=SECONDS)
        self._open.append(terminal)
        return terminal

    def turtlesim(self, *words: str) -> pexpect.spawn[str]:
        terminal = self.open(shlex.join(["ros2", "run", "turtlesim", "turtlesim_node", *words]))
        terminal.expect("lab window")
        return terminal

    def python(self, code: str) -> Any:
        """Run code with a node, and return what it says."""
        file = self._folder / "tester.py"
        file.write_text(NODE + code)
        done = self.run(f"python3 {shlex.quote(str(file))}")
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)

    def watch(self) -> Callable[..., Pose]:
        """Return a function that waits for a pose of turtle1, and does something `again` meanwhile."""
        file = self._folder / "watch.py"
        file.write_text(NODE + WATCH)
        terminal = self.open(f"python3 {shlex.quote(str(file))}")

        def wait(fits: Callable[[Pose], bool], again: Callable[[], object] = int) -> Pose:
            for count in range(MOST_POSES):
                terminal.expect(r"\{[^}]*\}")
                pose: Pose = json.loads(terminal.match.group())
                if fits(pose):
                    return pose
                if count % POSES_BETWEEN == 0:
                    again()
            raise AssertionError(f"no such pose; the last one: {pose}")

        wait(lambda _: True)
        return wait

    def close(self) -> None:
        """End each command with its whole process group: ros2 run's program outlives ros2 run."""
        for terminal in self._open:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(terminal.pid, signal.SIGKILL)
            terminal.close(force=True)


@pytest.fixture
def terminals(tmp_path: Path) -> Iterator[Terminals]:
    opened = Terminals(proven_ros(find_distro("jazzy"), interfaces=("turtlesim",)).path, tmp_path)
    yield opened
    opened.close()


def ended(terminal: pexpect.spawn[str]) -> tuple[int | None, str]:
    """Wait for a program's end; return its exit status and what it printed before."""
    terminal.expect(pexpect.EOF)
    terminal.close()
    return terminal.exitstatus, terminal.before


def near(wanted: float, within: float = 0.03) -> Callable[[Pose], bool]:
    return lambda pose: abs(math.remainder(pose["theta"] - wanted, 2 * math.pi)) < within


def test_the_package_has_the_programs_of_the_real_one(terminals: Terminals) -> None:
    listed = terminals.run("ros2 pkg executables turtlesim").stdout.splitlines()
    programs = ["draw_square", "mimic", "turtle_teleop_key", "turtlesim_node"]
    assert listed == [f"turtlesim {name}" for name in programs]


def test_it_starts_as_the_real_one_and_ends_quietly(terminals: Terminals) -> None:
    terminal = terminals.open("ros2 run turtlesim turtlesim_node")
    terminal.expect(re.escape("[turtlesim]: Starting turtlesim with node name /turtlesim"))
    place = "x=[5.544445], y=[5.544445], theta=[0.000000]"  # as the real one prints it
    terminal.expect(re.escape(f"[turtlesim]: Spawning turtle [turtle1] at {place}"))
    terminal.expect(r"no window of its own[^\n]*lab window")
    terminal.sendintr()
    status, printed = ended(terminal)
    assert status == 0
    assert re.fullmatch(r"\S*\s*(\^C)?\s*", printed)


def test_names_and_parameters_are_those_of_the_arguments(terminals: Terminals) -> None:
    words = ["-r", "__node:=sea", "-r", "__ns:=/deep", "-p", "background_b:=7"]
    terminals.open(shlex.join(["ros2", "run", "turtlesim", "turtlesim_node", "--ros-args", *words]))
    found = terminals.python("""
from rcl_interfaces.srv import GetParameters
names = [f"background_{letter}" for letter in "rgb"]
answer = call(GetParameters, "/deep/sea/get_parameters", names=names)
pose_of("/deep/turtle1")
say(colour=[value.integer_value for value in answer.values])
""")
    assert found == {"colour": [69, 86, 7]}


@pytest.mark.parametrize(
    ("words", "named"),
    [
        ("--ros-args -p background_r:=300", "background_r"),
        ("--ros-args -p background_r:=red", "background_r"),
        ("--ros-args --nonsense", "--nonsense"),
        ("fast", "fast"),
    ],
)
def test_wrong_arguments_are_told_in_one_line(terminals: Terminals, words: str, named: str) -> None:
    done = terminals.run(f"ros2 run turtlesim turtlesim_node {words}")
    assert done.returncode == 1
    (line,) = [line for line in done.stderr.splitlines() if not line.startswith("[INFO]")]
    assert line.startswith("turtlesim_node: ")
    assert named in line


def test_a_command_moves_it_for_a_second_of_the_wall_clock(terminals: Terminals) -> None:
    terminals.turtlesim()
    found = terminals.python("""
import time
publisher = node.create_publisher(Twist, "turtle1/cmd_vel", 1)
while not publisher.get_subscription_count():
    rclpy.spin_once(node, timeout_sec=0.1)
twist = Twist()
twist.linear.x, twist.angular.z = 1.0, 1.0
begin = time.monotonic()
publisher.publish(twist)
begun = pose_of("turtle1", lambda pose: pose.linear_velocity > 0)
ended = pose_of("turtle1", lambda pose: pose.linear_velocity == 0)
say(speed=begun.linear_velocity, turn=begun.angular_velocity, x=ended.x, y=ended.y,
    theta=ended.theta, seconds=time.monotonic() - begin)
""")
    assert (found["speed"], found["turn"]) == (1.0, 1.0)
    # no update is made up for, so a busy machine makes fewer than the 62 of the second
    assert 0.3 < found["theta"] < 1.01
    assert found["seconds"] > 0.98
    assert found["x"] - MIDDLE == pytest.approx(math.sin(found["theta"]), abs=0.02)
    assert found["y"] - MIDDLE == pytest.approx(1 - math.cos(found["theta"]), abs=0.02)


def test_the_wall_is_told_and_others_are_spawned_and_killed(terminals: Terminals) -> None:
    terminal = terminals.turtlesim()
    found = terminals.python("""
call(srv.TeleportAbsolute, "turtle1/teleport_absolute", x=11.0, y=5.0, theta=0.0)
publisher = node.create_publisher(Twist, "turtle1/cmd_vel", 1)
while not publisher.get_subscription_count():
    rclpy.spin_once(node, timeout_sec=0.1)
twist = Twist()
twist.linear.x = 2.0
publisher.publish(twist)
wall = pose_of("turtle1", lambda pose: pose.x > 11.08).x
names = [call(srv.Spawn, "spawn", x=1.0, y=2.0, theta=0.5).name,
         call(srv.Spawn, "spawn", x=3.0, y=4.0, theta=0.0, name="ada").name,
         call(srv.Spawn, "spawn", x=3.0, y=4.0, theta=0.0, name="ada").name]
second = pose_of("turtle2")
call(srv.Kill, "kill", name="ada")
call(Empty, "reset")
middle = pose_of("turtle1", lambda pose: pose.x < 6)
say(wall=wall, names=names, second=[second.x, second.y, second.theta], middle=middle.x)
""")
    assert found["wall"] == pytest.approx(499 / 45)
    assert found["names"] == ["turtle2", "ada", ""]
    assert found["second"] == pytest.approx([1, 2, 0.5])
    assert found["middle"] == pytest.approx(MIDDLE)
    terminal.expect(
        r"\[WARN\][^\n]*Oh no! I hit the wall! \(Clamping from \[x=11\.\d+, y=5\.\d+\]\)"
    )
    terminal.expect(re.escape("Spawning turtle [ada] at x=[3.000000], y=[4.000000]"))
    terminal.expect(re.escape("A turtle named [ada] already exists"))
    terminal.expect("Resetting turtlesim")


def test_a_turtle_that_turns_can_be_killed(terminals: Terminals) -> None:
    terminals.turtlesim()
    found = terminals.python("""
from rclpy.action import ActionClient
turns = []
def turn(theta):
    client = ActionClient(node, action.RotateAbsolute, "ada/rotate_absolute")
    assert client.wait_for_server(20)
    goal = client.send_goal_async(action.RotateAbsolute.Goal(theta=theta))
    rclpy.spin_until_future_complete(node, goal, timeout_sec=20)
    return goal.result()
call(srv.Spawn, "spawn", x=3.0, y=4.0, theta=0.0, name="ada")
turn(3.0)
call(srv.Kill, "kill", name="ada")
call(srv.Spawn, "spawn", x=3.0, y=4.0, theta=0.0, name="ada")
ended = turn(0.5).get_result_async()
rclpy.spin_until_future_complete(node, ended, timeout_sec=20)
say(status=ended.result().status, theta=pose_of("ada").theta)
""")
    assert found["status"] == 4  # action_msgs/msg/GoalStatus.STATUS_SUCCEEDED
    assert found["theta"] == pytest.approx(0.5, abs=0.03)


def test_the_keys_drive_and_turn_the_turtle(terminals: Terminals) -> None:
    terminals.turtlesim()
    pose = terminals.watch()
    keys = terminals.open("ros2 run turtlesim turtle_teleop_key")
    keys.expect("arrow keys.*g.b.v.c.d.e.r.t.*quits")
    # (the first key may come before the two nodes have found each other)
    assert pose(lambda p: p["x"] > MIDDLE + 0.5, lambda: keys.send(UP))["y"] == pytest.approx(
        MIDDLE
    )
    keys.send(LEFT)
    pose(lambda p: p["theta"] > 0.5)
    pose(near(math.pi / 2), lambda: keys.send("r"))
    keys.send("g")
    pose(near(0))
    keys.send("c")
    pose(lambda p: p["theta"] < -0.5)
    keys.send("f")  # … and an arrow key drives on from where it stopped
    before = pose(lambda _: True)
    keys.send(UP)
    pose(lambda p: math.hypot(p["x"] - before["x"], p["y"] - before["y"]) > 0.5)
    assert pose(lambda _: True)["theta"] > -2.3
    keys.send("q")
    assert ended(keys)[0] == 0


@pytest.mark.parametrize("end", ["q", "\x03", "\x04"])
def test_the_terminal_of_the_keys_is_left_as_it_was(terminals: Terminals, end: str) -> None:
    shell = terminals.open("bash --norc")
    before = termios.tcgetattr(shell.child_fd)
    shell.sendline("ros2 run turtlesim turtle_teleop_key; echo status $?")
    shell.expect("quits")
    shell.send(end)
    shell.expect(r"status (\d+)")
    assert shell.match.group(1) == "0"
    shell.sendline("stty -a | tr ' ' '\\n' | grep -x -e '-*icanon' -e '-*echo'; echo done")
    shell.expect("[^-]icanon\r\necho\r\ndone")
    assert termios.tcgetattr(shell.child_fd)[3] & termios.ISIG == before[3] & termios.ISIG


def test_without_a_terminal_the_keys_program_says_so(terminals: Terminals) -> None:
    done = terminals.run("ros2 run turtlesim turtle_teleop_key")
    assert done.returncode == 1
    assert done.stderr == "turtle_teleop_key reads the keys of a terminal, but its input is none\n"


@pytest.mark.full
def test_a_square_is_drawn_and_mimicked(terminals: Terminals) -> None:
    terminals.turtlesim()
    square = terminals.open("ros2 run turtlesim draw_square")
    square.expect("New goal")
    remaps = "-r input/pose:=turtle1/pose -r output/cmd_vel:=ada/cmd_vel"
    terminals.open(f"ros2 run turtlesim mimic --ros-args {remaps}")
    found = terminals.python("""
call(srv.Spawn, "spawn", x=1.0, y=1.0, theta=0.0, name="ada")
first = pose_of("turtle1", lambda pose: abs(pose.theta - 1.5708) < 0.02 and pose.linear_velocity > 0)
mimicking = pose_of("ada", lambda pose: pose.linear_velocity > 0)
say(x=first.x, y=first.y, speed=mimicking.linear_velocity)
""")
    assert found["x"] - MIDDLE == pytest.approx(2, abs=0.2)
    assert MIDDLE - 0.2 < found["y"] < MIDDLE + 2.2  # (somewhere on the second side)
    assert found["speed"] == 1
    square.expect("Reached goal")
    square.sendintr()
    assert ended(square)[0] == 0


@pytest.mark.long  # it makes another prefix
def test_kilted_has_the_package_beside_that_of_the_messages(tmp_path: Path) -> None:
    kilted = Terminals(proven_ros(find_distro("kilted"), interfaces=("turtlesim",)).path, tmp_path)
    try:
        listed = kilted.run("ros2 pkg executables turtlesim").stdout
        assert "turtlesim turtlesim_node\n" in listed
        terminal = kilted.turtlesim()
        assert kilted.python('say(x=pose_of("turtle1").x)')["x"] == pytest.approx(MIDDLE)
        terminal.sendintr()  # kilted's `ros2 run` sends it on, so it comes twice
        status, printed = ended(terminal)
        assert status == 0
        assert "Traceback" not in printed
    finally:
        kilted.close()


def test_other_programs_or_another_world_are_another_prefix(
    ros_jazzy: Ros, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = interfaces.interfaces_path(ros_jazzy)
    world = tmp_path / "turtlesim.py"
    world.write_text(turtlesim_executables.WORLD.read_text() + "# another one\n")
    with monkeypatch.context() as patched:
        patched.setattr(turtlesim_executables, "WORLD", world)
        assert interfaces.interfaces_path(ros_jazzy) != before
    programs = tmp_path / "programs"
    programs.mkdir()
    for source in turtlesim_executables.PROGRAMS.glob("*.py"):
        (programs / source.name).write_text(source.read_text() + "# another one\n")
    monkeypatch.setattr(turtlesim_executables, "PROGRAMS", programs)
    assert interfaces.interfaces_path(ros_jazzy) != before
