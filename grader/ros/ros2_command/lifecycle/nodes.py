"""Output a list of nodes with lifecycle."""

from argparse import Namespace

from .. import graph, managed_nodes
from ..parsing import Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 lifecycle nodes`."""
    graph.add_arguments(parser)
    parser.add_argument(
        *("-a", "--all"),
        dest="include_hidden_nodes",
        action="store_true",
        help="Display all nodes even hidden ones",
    )
    parser.add_argument(
        *("-c", "--count-nodes"),
        action="store_true",
        help="Only display the number of nodes discovered",
    )


def main(args: Namespace) -> None:
    """Print the full names of the managed nodes, sorted, or their number."""
    with graph.graph(args) as node:
        found = managed_nodes.names(node, args)
    if args.count_nodes:
        print(len(found))
        return
    for name in found:
        print(name)
