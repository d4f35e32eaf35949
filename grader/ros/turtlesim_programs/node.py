"""turtlesim_node: the marking's world turtlesim on the wall clock.

One update in 16 ms, each of the same length, however late it comes: so does the real one.
"""

from __future__ import annotations

import threading
import time
from ctypes import c_float
from typing import Any

from rclpy.callback_groups import CallbackGroup
from wheels_turtlesim.world import DT, STEP, World

from .program import End, start

NO_WINDOW = (
    "This turtlesim has no window of its own. To see the turtles, type in another terminal of the "
    "lab: lab window"
)


class Untouched(CallbackGroup):  # type: ignore[misc]
    """A callback group of which the executor runs nothing: the world takes its messages itself."""

    def can_execute(self, _: Any) -> bool:
        """Return False."""
        return False

    def beginning_execution(self, _: Any) -> bool:
        """Return False."""
        return False

    def ending_execution(self, _: Any) -> None:
        """Do nothing."""


class Turtlesim:
    """The world on the clock of its node."""

    def __init__(self, node: Any) -> None:
        self._node = node
        log = node.get_logger()
        log.info(f"Starting turtlesim with node name {node.get_fully_qualified_name()}")
        self.world = World(node, Untouched())
        for name, turtle in self.world.field.turtles.items():
            x, y = (c_float(at).value for at in (turtle.x, turtle.y))  # as a pose has it
            place = f"x=[{x:f}], y=[{y:f}], theta=[{turtle.theta:f}]"
            log.info(f"Spawning turtle [{name}] at {place}")
        log.info(NO_WINDOW)

    def update(self) -> None:
        """Take the commands that have come, and move the turtles by one step."""
        now = self._node.get_clock().now().nanoseconds
        turned = self._turning()
        self.world.collect(now)
        self.world.field.now = now - STEP
        self.world.advance(now)
        self.world.steps.clear()  # evidence for the marking
        self.world.events.clear()
        if turned - self._turning():
            self._node.executor.wake()  # it does not see that the goal's future is done

    def _turning(self) -> set[str]:
        """Return the names of the turtles that turn to a goal."""
        return {name for name, one in self.world.field.turtles.items() if one.goal is not None}


def main() -> int:
    """Run turtlesim until Ctrl+C."""
    turn = threading.Lock()

    def run(node: Any, end: End) -> None:
        with turn:
            turtlesim = Turtlesim(node)
        due = time.monotonic()
        while not end.within(max(0.0, due - time.monotonic())):
            with turn:
                turtlesim.update()
            due = max(due + DT, time.monotonic())  # what was missed is not made up for

    return start("turtlesim", run, turn)
