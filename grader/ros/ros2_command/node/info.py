"""Output information about a node."""

import sys
from argparse import Namespace
from typing import Any

from .. import actions, graph
from ..parsing import CommandError, Parser

# the parts of an action's names on the graph, which are not shown as topics and services
ACTION_PART = f"/{actions.PART}/"


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 node info`."""
    graph.add_arguments(parser)
    parser.add_argument("node_name", help="Full name of the node (e.g. '/talker')")
    parser.add_argument(
        "--include-hidden", action="store_true", help="Display hidden topics, services and actions"
    )


def main(args: Namespace) -> None:
    """Print the topics, services and actions that a node has.

    Raises CommandError if there is no such node.
    """
    with graph.graph(args) as node:
        found = graph.node_names(node)
        if args.node_name not in found:
            raise CommandError(f"Unable to find node '{args.node_name}'")
        if found.count(args.node_name) > 1:
            print(
                f"There are {found.count(args.node_name)} nodes in the graph with the exact name "
                f'"{args.node_name}". You are seeing information about only one of them.',
                file=sys.stderr,
            )
        namespace, _, name = args.node_name.rpartition("/")
        sections = _sections(node, name, namespace or "/")
    print(args.node_name)
    for title, interfaces in sections.items():
        print(f"  {title}:")
        shown = [each for each in sorted(interfaces) if args.include_hidden or not _hidden(each[0])]
        print("\n".join(f"    {each}: {', '.join(types)}" for each, types in shown))


def _hidden(name: str) -> bool:
    return ACTION_PART in name or graph.is_hidden(name)


def _sections(node: Any, name: str, namespace: str) -> dict[str, list[tuple[str, list[str]]]]:
    from rclpy import action  # noqa: PLC0415 (slow to import)

    return {
        "Subscribers": node.get_subscriber_names_and_types_by_node(name, namespace),
        "Publishers": node.get_publisher_names_and_types_by_node(name, namespace),
        "Service Servers": node.get_service_names_and_types_by_node(name, namespace),
        "Service Clients": node.get_client_names_and_types_by_node(name, namespace),
        "Action Servers": action.get_action_server_names_and_types_by_node(node, name, namespace),
        "Action Clients": action.get_action_client_names_and_types_by_node(node, name, namespace),
    }
