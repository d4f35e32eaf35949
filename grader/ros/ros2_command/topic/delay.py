"""Display delay of topic from timestamp in header."""

from __future__ import annotations

import statistics
from collections import deque
from typing import TYPE_CHECKING, Any

from .. import graph, topics
from ..parsing import CommandError, Parser, positive

if TYPE_CHECKING:
    from argparse import Namespace

WINDOW = 10_000  # messages
SECOND = 1_000_000_000  # nanoseconds

PERIOD = 1.0  # seconds between two lines


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 topic delay`."""
    graph.add_arguments(parser)
    parser.add_argument("topic_name", help="Name of the topic to listen to (e.g. '/chatter')")
    parser.add_argument(
        "--window",
        "-w",
        metavar="WINDOW",
        type=positive,
        default=WINDOW,
        help=f"Number of messages of which the delay is the average (default: {WINDOW})",
    )


def main(args: Namespace) -> None:
    """Print the delay once a second until Ctrl+C; wait if the topic is not published yet.

    Raises CommandError if the messages have no header, or their type is not installed.
    """
    from rclpy.clock import Clock, ClockType  # noqa: PLC0415 (slow to import)
    from rclpy.qos import qos_profile_sensor_data  # noqa: PLC0415
    from rclpy.time import Time  # noqa: PLC0415

    with graph.graph(args, carries_data=True) as node:
        kind = topics.message_class(node, args.topic_name, patient=True)
        if "header" not in kind.get_fields_and_field_types():
            raise CommandError("msg does not have header")
        delays: deque[float] = deque(maxlen=args.window)
        counts = [0, 0]  # received, and received when the last text was printed

        def receive(message: Any) -> None:
            sent = Time.from_msg(message.header.stamp)
            delays.append((node.get_clock().now().nanoseconds - sent.nanoseconds) / SECOND)
            counts[0] += 1

        def report() -> None:
            if delays:
                print(text(delays) if counts[0] > counts[1] else "no new messages")
            counts[1] = counts[0]

        name = topics.full_name(node, args.topic_name)
        node.create_subscription(kind, name, receive, qos_profile_sensor_data)
        node.create_timer(PERIOD, report, clock=Clock(clock_type=ClockType.STEADY_TIME))
        topics.spin_while(node)


def text(delays: deque[float]) -> str:
    """Return what is printed of delays in seconds."""
    return (
        f"average delay: {statistics.fmean(delays):.3f}\n\tmin: {min(delays):.3f}s "
        f"max: {max(delays):.3f}s std dev: {statistics.pstdev(delays):.5f}s window: {len(delays)}"
    )
