"""Publish a message to a topic."""

from __future__ import annotations

import time
from itertools import count
from typing import TYPE_CHECKING, Any

from .. import graph, message_fields, qos, topics
from ..interfaces import load
from ..parsing import CommandError, Parser, natural, positive_float

if TYPE_CHECKING:
    from argparse import Namespace

POLL = 0.1  # seconds between two looks for subscriptions


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 topic pub`."""
    graph.add_arguments(parser)
    add = parser.add_argument
    add("topic_name", help="Name of the topic to publish to (e.g. '/chatter')")
    add("message_type", help="Type of the message (e.g. 'std_msgs/msg/String')")
    add("values", nargs="?", default="{}", help='Values of its fields, as YAML ("{data: hello}")')
    add(
        "-r",
        "--rate",
        metavar="N",
        type=positive_float,
        default=1.0,
        help="Messages per second (default: 1)",
    )
    add("-p", "--print", metavar="N", type=int, default=1, help="Print every N-th message only")
    group = parser.add_mutually_exclusive_group()
    group.add_argument("-1", "--once", action="store_true", help="Publish one message, then exit")
    group.add_argument(
        "-t", "--times", metavar="N", type=natural, default=0, help="Publish N messages, then exit"
    )
    add(
        "-w",
        "--wait-matching-subscriptions",
        metavar="N",
        type=natural,
        help="Wait for N subscriptions first (default: 1 with --once or --times, else 0)",
    )
    add(
        "--max-wait-time-secs",
        metavar="N",
        type=positive_float,
        help="Seconds to wait for the subscriptions at most",
    )
    add(
        "--keep-alive",
        metavar="N",
        type=positive_float,
        default=0.1,
        help="Seconds to stay after the last message (default: 0.1)",
    )
    add("-n", "--node-name", help="Name of the publishing node")
    qos.add_arguments(parser, profile="default", endpoint="publisher")


def main(args: Namespace) -> str | None:
    """Publish until Ctrl+C, or as often as asked; return an error message or None.

    Raises CommandError for a message that cannot be made.
    """
    times = 1 if args.once else args.times
    kind = load(args.message_type, "msg")
    values = message_fields.parse(args.values)
    with graph.graph(args, name=args.node_name, carries_data=True) as node:
        message = kind()
        try:
            stamps = message_fields.fill(message, values, lambda: node.get_clock().now().to_msg())
        except (AttributeError, TypeError, ValueError, AssertionError, OverflowError) as error:
            raise CommandError(f"Failed to populate field: {error}") from None
        name = topics.full_name(node, args.topic_name)
        publisher = node.create_publisher(kind, name, qos.profile(args))
        wanted = args.wait_matching_subscriptions
        _wait(publisher, (1 if times else 0) if wanted is None else wanted, args.max_wait_time_secs)
        print("publisher: beginning loop")
        start = time.monotonic()
        for n in count(1):
            for stamp in stamps:
                stamp()
            if args.print and n % args.print == 0:
                print(f"publishing #{n}: {message!r}\n")
            publisher.publish(message)
            if n == times:
                break
            time.sleep(max(0.0, start + n / args.rate - time.monotonic()))
        time.sleep(args.keep_alive)
    return None


def _wait(publisher: Any, wanted: int, longest: float | None) -> None:
    for n in count():
        if publisher.get_subscription_count() >= wanted:
            return
        if longest is not None and n * POLL >= longest:
            raise CommandError(
                f"Timed out waiting for subscribers: Expected {wanted} subscribers but only got "
                f"{publisher.get_subscription_count()} subscribers"
            )
        if n % round(1 / POLL) == 0:
            print(f"Waiting for at least {wanted} matching subscription(s)...")
        time.sleep(POLL)
