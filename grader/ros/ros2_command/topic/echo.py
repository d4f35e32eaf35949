"""Output messages from a topic."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from .. import graph, message_yaml, qos, topics
from ..interfaces import load
from ..parsing import CommandError, Parser, natural, positive_float

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Iterator

FLAGS = {
    "--csv": "Print the values separated by commas, one message per line",
    "--no-arr": "Print the type and length of arrays instead of their elements",
    "--no-str": "Print the length of texts instead of the texts",
    "--flow-style": "Print nested values and arrays in one line (YAML's flow style)",
    "--lost-messages": "No effect: lost messages are reported by default",
    "--no-lost-messages": "Do not report lost messages",
    "--raw": "Print the serialised bytes",
    "--once": "Print the first message, then exit",
    "--include-message-info": "Print the message's info (such as its time stamps) first",
}


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 topic echo`."""
    graph.add_arguments(parser)
    add = parser.add_argument
    add("topic_name", help="Name of the topic to listen to (e.g. '/chatter')")
    add("message_type", nargs="?", help="Type of its messages (e.g. 'std_msgs/msg/String')")
    qos.add_arguments(parser, profile="sensor_data", endpoint="subscription")
    add("--field", metavar="NAME", help="Print one field only; inner ones after dots: pose.x")
    add(
        "--full-length",
        "-f",
        action="store_true",
        help="Print all elements of arrays and all characters of texts",
    )
    add(
        "--truncate-length",
        "-l",
        metavar="N",
        type=natural,
        default=message_yaml.LONGEST,
        help=f"Elements and characters to print at most (default: {message_yaml.LONGEST})",
    )
    add(
        "--filter",
        metavar="EXPR",
        help="Print only messages for which this Python expression is true; the message is `m`",
    )
    add("--timeout", metavar="N", type=positive_float, help="Exit after this many seconds")
    for flag, text in FLAGS.items():
        add(flag, action="store_true", help=text)


def main(args: Namespace) -> None:
    """Print messages until Ctrl+C, the first one with `--once`, or `--timeout`.

    Raises CommandError if the type cannot be found out, or a field does not exist.
    """
    with graph.graph(args, carries_data=True) as node:
        if args.message_type is None:
            kind = topics.message_class(node, args.topic_name, patient=False)
        else:
            kind = load(args.message_type, "msg")
        name = topics.full_name(node, args.topic_name)
        accepts = topics.message_filter(args.filter)
        printed: list[bool] = []

        def receive(message: Any, info: Any) -> None:
            if (args.once and printed) or (accepts and not args.raw and not accepts(message)):
                return
            if args.include_message_info:
                print(info)
            print(_text(message, args))
            printed.append(True)

        events = None if args.no_lost_messages else _report_lost()
        node.create_subscription(
            kind,
            name,
            receive,
            qos.matching(args, node, name),
            raw=args.raw,
            event_callbacks=events,
        )
        topics.spin_while(node, _going(printed if args.once else [], args.timeout), timeout=0.2)


def _going(ended: list[bool], timeout: float | None) -> Iterator[bool]:
    end = time.monotonic() + (timeout or float("inf"))
    while True:
        yield not ended and time.monotonic() < end


def _text(message: Any, args: Namespace) -> str:
    """Return what is printed of a message."""
    if args.raw:
        return f"{message!r}\n---"
    value = _field(message, args.field) if args.field else message
    style = message_yaml.style(args)
    if args.csv:
        return message_yaml.to_csv(value, style)
    if message_yaml.is_message(value):
        return f"{message_yaml.to_yaml(value, style)}---"
    return f"{value}\n---"


def _field(message: Any, path: str) -> Any:
    value = message
    for name in path.split("."):
        try:
            value = getattr(value, name)
        except AttributeError as error:
            raise CommandError(f"Invalid field '{path}': {error}") from None
    return value


def _report_lost() -> Any:
    from rclpy.event_handler import SubscriptionEventCallbacks  # noqa: PLC0415 (slow to import)

    def lost(info: Any) -> None:
        print(
            "A message was lost!!!\n\ttotal count change:"
            f"{info.total_count_change}\n\ttotal count: {info.total_count}",
        )

    return SubscriptionEventCallbacks(message_lost=lost)
