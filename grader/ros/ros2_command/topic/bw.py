"""Display bandwidth used by topic."""

from __future__ import annotations

import time
from collections import deque
from typing import TYPE_CHECKING

from .. import graph, topics
from ..parsing import Parser, positive

if TYPE_CHECKING:
    from argparse import Namespace

WINDOW = 100  # messages

SECOND = 1.0


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 topic bw`."""
    graph.add_arguments(parser)
    parser.add_argument("topic_name", help="Name of the topic to listen to (e.g. '/chatter')")
    parser.add_argument(
        "--window",
        "-w",
        metavar="WINDOW",
        type=positive,
        default=WINDOW,
        help=f"Number of messages of which the bandwidth is the average (default: {WINDOW})",
    )


def main(args: Namespace) -> None:
    """Print the bandwidth once a second until Ctrl+C; wait if the topic is not published yet.

    Raises CommandError if the type is not installed.
    """
    from rclpy.clock import Clock, ClockType  # noqa: PLC0415 (slow to import)
    from rclpy.qos import qos_profile_sensor_data  # noqa: PLC0415

    with graph.graph(args, carries_data=True) as node:
        kind = topics.message_class(node, args.topic_name, patient=True)
        seen: deque[tuple[float, int]] = deque(maxlen=args.window)

        def receive(message: bytes) -> None:
            seen.append((time.monotonic(), len(message)))

        def report() -> None:
            if len(seen) > 1:
                print(text(list(seen), time.monotonic()))

        name = topics.full_name(node, args.topic_name)
        node.create_subscription(kind, name, receive, qos_profile_sensor_data, raw=True)
        print(f"Subscribed to [{args.topic_name}]")
        node.create_timer(SECOND, report, clock=Clock(clock_type=ClockType.STEADY_TIME))
        topics.spin_while(node)


def text(seen: list[tuple[float, int]], now: float) -> str:
    """Return what is printed of messages that arrived at times (seconds) with sizes (bytes)."""
    sizes = [size for _, size in seen]
    rate = sum(sizes) / (now - seen[0][0])
    unit, divisor, digits = "B", 1, 0
    if rate >= 1_000:
        unit, divisor, digits = ("KB", 1_000, 2) if rate < 1_000_000 else ("MB", 1_000_000, 2)

    def amount(value: float) -> str:
        return f"{value / divisor:.{digits}f} {unit}"

    return (
        f"{amount(rate)}/s from {len(sizes)} messages\n\tMessage size mean: "
        f"{amount(sum(sizes) / len(sizes))} min: {amount(min(sizes))} max: {amount(max(sizes))}"
    )
