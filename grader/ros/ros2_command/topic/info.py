"""Print information about a topic."""

from argparse import Namespace
from typing import Any

from .. import graph, topics
from ..parsing import CommandError, Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 topic info`."""
    graph.add_arguments(parser)
    parser.add_argument("topic_name", help="Name of the topic (e.g. '/chatter')")
    parser.add_argument(
        "-v",
        "--verbose",
        action="store_true",
        help="Also print the node, type and quality of service of each publisher and subscription",
    )


def main(args: Namespace) -> None:
    """Print the topic's type and the number of its endpoints, or their details.

    Raises CommandError if the topic is unknown.
    """
    with graph.graph(args) as node:
        types = topics.types(node, args.topic_name)
        if not types:
            raise CommandError(f"Unknown topic '{args.topic_name}'")
        print(f"Type: {types[0] if len(types) == 1 else types}")
        endpoints = {
            "Publisher": node.get_publishers_info_by_topic(args.topic_name),
            "Subscription": node.get_subscriptions_info_by_topic(args.topic_name),
        }
    for role, infos in endpoints.items():
        if args.verbose:
            print()
        print(f"{role} count: {len(infos)}")
        if args.verbose:
            _print_each(infos)


def _print_each(infos: list[Any]) -> None:
    for info in infos:
        print(f"\n{info}")  # rclpy's text is the real command's
