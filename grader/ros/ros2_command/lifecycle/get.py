"""Get lifecycle state for one or more nodes."""

from argparse import Namespace

from .. import graph, managed_nodes
from ..parsing import Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 lifecycle get`."""
    graph.add_arguments(parser)
    parser.add_argument(
        "node_name",
        nargs="?",
        help="Name of the ROS node. If no name is provided, then get the state for all nodes.",
    )
    parser.add_argument(
        *("--include-hidden-nodes", "-a", "--all"),
        action="store_true",
        help="Consider hidden nodes as well",
    )


def main(args: Namespace) -> None:
    """Print the state of a node, or of each managed node.

    Raises CommandError if the node is not there or not managed.
    """
    with graph.graph(args) as node:
        if args.node_name:
            print(managed_nodes.state(node, managed_nodes.named(node, args)))
            return
        for name in managed_nodes.names(node, args):
            print(f"{name}: {managed_nodes.state(node, name)}")
