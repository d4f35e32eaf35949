"""turtle_teleop_key: drives turtle1 with the keys of the terminal."""

from __future__ import annotations

import contextlib
import math
import os
import select
import signal
import sys
import termios
import tty
from collections.abc import Iterator
from typing import Any

from geometry_msgs.msg import Twist
from rclpy.action import ActionClient

from .program import End, interfaces, start

HELP = """\
Reading from keyboard
---------------------------
The arrow keys move the turtle.
The keys g|b|v|c|d|e|r|t turn it to the direction in which they lie around f. 'f' stops a turn.
'q' quits."""
NO_TERMINAL = "turtle_teleop_key reads the keys of a terminal, but its input is none"
ARROWS = {"A": (1.0, 0.0), "B": (-1.0, 0.0), "C": (0.0, -1.0), "D": (0.0, 1.0)}
"""Forward and turn for the last letter of an arrow key's sequence: up, down, right, left."""

EIGHTHS = {"g": 0, "t": 1, "r": 2, "e": 3, "d": 4, "c": -3, "v": -2, "b": -1}
"""The direction of a key in eighths of a turn, counterclockwise from the right."""

ESCAPE = "\x1b"
END_OF_INPUT = "\x04"  # Ctrl+D
WAIT_SECONDS = 0.1  # of wall time, after which the end is looked for
SEQUENCE_SECONDS = 0.05  # of wall time, within which the rest of an arrow key comes


class Keys:
    """The keys that are pressed in a terminal."""

    def __init__(self, descriptor: int) -> None:
        self._descriptor = descriptor
        self._waiting: list[str] = []

    def next(self, seconds: float) -> str:
        """Return the next key's letter; that of an arrow key stands after ESC.

        Returns "" if none was pressed in the time, Ctrl+D at the end of the input.
        """
        key = self._letter(seconds)
        if key != ESCAPE:
            return key
        if self._letter(SEQUENCE_SECONDS) not in ("[", "O"):
            return ""
        return ESCAPE + self._letter(SEQUENCE_SECONDS)

    def _letter(self, seconds: float) -> str:
        if not self._waiting and select.select([self._descriptor], [], [], seconds)[0]:
            try:
                read = os.read(self._descriptor, 1024)
            except OSError:  # the terminal was closed
                read = b""
            self._waiting += list(read.decode(errors="replace")) or [END_OF_INPUT]
        return self._waiting.pop(0) if self._waiting else ""


@contextlib.contextmanager
def single_keys(descriptor: int) -> Iterator[Keys]:
    """Let a terminal give each key at once, and as it was before at the end."""
    before = termios.tcgetattr(descriptor)

    def again(*_: object) -> None:
        tty.setcbreak(descriptor)

    signal.signal(signal.SIGCONT, again)  # (after Ctrl+Z and fg)
    again()
    try:
        yield Keys(descriptor)
    finally:
        signal.signal(signal.SIGCONT, signal.SIG_DFL)
        with contextlib.suppress(termios.error):  # the terminal was closed
            termios.tcsetattr(descriptor, termios.TCSADRAIN, before)


class Teleop:
    """What the keys do."""

    def __init__(self, node: Any) -> None:
        self._log = node.get_logger()
        for name in ("scale_angular", "scale_linear"):
            node.declare_parameter(name, 2.0)
        self._node = node
        self._publisher = node.create_publisher(Twist, "turtle1/cmd_vel", 1)
        self._type = interfaces("action").RotateAbsolute
        self._rotate = ActionClient(node, self._type, "turtle1/rotate_absolute")
        self._goal: Any = None

    def press(self, key: str) -> None:
        """Do what a key stands for; nothing if it stands for nothing."""
        if key.startswith(ESCAPE) and key[1:] in ARROWS:
            forward, turn = ARROWS[key[1:]]
            twist = Twist()
            twist.linear.x = forward * self._scale("linear")
            twist.angular.z = turn * self._scale("angular")
            self._publisher.publish(twist)
        elif key.lower() in EIGHTHS:
            self._turn(EIGHTHS[key.lower()] * math.pi / 4)
        elif key.lower() == "f" and self._goal is not None:
            self._goal.cancel_goal_async()
            self._goal = None

    def _scale(self, of: str) -> float:
        return float(self._node.get_parameter(f"scale_{of}").value)

    def _turn(self, theta: float) -> None:
        if not self._rotate.server_is_ready():
            self._log.warning("No turtle offers the action turtle1/rotate_absolute.")
            return
        answer = self._rotate.send_goal_async(self._type.Goal(theta=theta))
        answer.add_done_callback(self._answered)

    def _answered(self, future: Any) -> None:
        handle = future.result()
        if handle.accepted:
            self._goal = handle
        else:
            self._log.warning("The goal was rejected.")


def main() -> int:
    """Read keys until q, Ctrl+C or Ctrl+D."""
    if not sys.stdin.isatty():
        print(NO_TERMINAL, file=sys.stderr)
        return 1

    def run(node: Any, end: End) -> None:
        teleop = Teleop(node)
        with single_keys(sys.stdin.fileno()) as keys:
            print(HELP, flush=True)
            while not end.within(0):
                key = keys.next(WAIT_SECONDS)
                if key in ("q", "Q", END_OF_INPUT):
                    return
                teleop.press(key)

    return start("teleop_turtle", run)
