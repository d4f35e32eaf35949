"""Output a list of available transitions."""

from argparse import Namespace

from .. import graph, managed_nodes
from ..parsing import Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 lifecycle list`."""
    graph.add_arguments(parser)
    managed_nodes.add_name(parser)
    parser.add_argument("-a", "--all", action="store_true", help="Display all existing transitions")


def main(args: Namespace) -> None:
    """Print the transitions that a node can make in its state, or all that it has.

    Raises CommandError if the node is not there or not managed.
    """
    with graph.graph(args) as node:
        name = managed_nodes.named(node, args)
        for description in managed_nodes.transitions(node, name, every=args.all):
            print(managed_nodes.described(description))
