"""Print the average publishing rate to screen."""

from __future__ import annotations

import math
from collections import deque
from typing import TYPE_CHECKING, Any

from .. import graph, topics
from ..parsing import Parser, positive

if TYPE_CHECKING:
    from argparse import Namespace

WINDOW = 10_000  # messages
SECOND = 1_000_000_000  # nanoseconds


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 topic hz`."""
    graph.add_arguments(parser)
    add = parser.add_argument
    add("topic_name", help="Name of the topic to listen to (e.g. '/chatter')")
    add(
        "--window",
        "-w",
        dest="window_size",
        metavar="WINDOW",
        type=positive,
        default=WINDOW,
        help=f"Number of messages of which the rate is the average (default: {WINDOW})",
    )
    add(
        "--filter",
        metavar="EXPR",
        help="Count only messages for which this Python expression is true; the message is `m`",
    )
    add("--wall-time", action="store_true", help="Measure in wall time, not in ROS time")


def main(args: Namespace) -> None:
    """Print the rate once a second until Ctrl+C; wait if the topic is not published yet.

    Raises CommandError if the type is not installed.
    """
    from rclpy.clock import Clock, ClockType  # noqa: PLC0415 (slow to import)
    from rclpy.qos import qos_profile_sensor_data  # noqa: PLC0415

    accepts = topics.message_filter(args.filter)
    with graph.graph(args, carries_data=True) as node:
        kind = topics.message_class(node, args.topic_name, patient=True)
        clock = Clock(clock_type=ClockType.SYSTEM_TIME) if args.wall_time else node.get_clock()
        rate = Rate(args.window_size)

        def receive(message: Any) -> None:
            if accepts is None or accepts(message):
                text = rate.arrived(clock.now().nanoseconds)
                if text:
                    print(text)

        node.create_subscription(
            kind,
            topics.full_name(node, args.topic_name),
            receive,
            qos_profile_sensor_data,
            raw=accepts is None,
        )
        topics.spin_while(node)


class Rate:
    """The intervals between messages, of which a text is due every second."""

    def __init__(self, window: int) -> None:
        self._gaps: deque[int] = deque(maxlen=window)  # nanoseconds
        self._last: int | None = None
        self._printed: int | None = None

    def arrived(self, now: int) -> str | None:
        """Note a message (at a time in nanoseconds); return the text if it is due."""
        if self._last is None or now < self._last:  # the first one, or time was set back
            self._gaps.clear()
            self._last, self._printed = now, None
            return None
        self._gaps.append(now - self._last)
        self._last = now
        if self._printed is None:
            self._printed = now
        if now < self._printed + SECOND:
            return None
        self._printed = now
        return self._text()

    def _text(self) -> str:
        gaps = [gap / SECOND for gap in self._gaps]
        mean = sum(gaps) / len(gaps)
        deviation = math.sqrt(sum((gap - mean) ** 2 for gap in gaps) / len(gaps))
        return (
            f"average rate: {1 / mean if mean else 0:.3f}\n\tmin: {min(gaps):.3f}s "
            f"max: {max(gaps):.3f}s std dev: {deviation:.5f}s window: {len(gaps)}"
        )
