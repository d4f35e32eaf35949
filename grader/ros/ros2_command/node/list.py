"""Output a list of available nodes."""

import sys
from argparse import Namespace

from .. import graph
from ..parsing import Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 node list`."""
    graph.add_arguments(parser)
    parser.add_argument(
        "-a", "--all", action="store_true", help="Display all nodes even hidden ones"
    )
    parser.add_argument(
        "-c",
        "--count-nodes",
        action="store_true",
        help="Only display the number of nodes discovered",
    )


def main(args: Namespace) -> None:
    """Print the nodes' full names, sorted, or their number.

    Raises what `graph.graph` raises.
    """
    with graph.graph(args) as node:
        found = graph.node_names(node)
    hidden = f"/{graph.HIDDEN_PREFIX}"
    names = [name for name in found if args.all or hidden not in name[name.rindex("/") :]]
    if args.count_nodes:
        print(len(names))
        return
    if len(set(names)) < len(names):
        print(
            "WARNING: Be aware that there are nodes in the graph that share an exact name, "
            "which can have unintended side effects.",
            file=sys.stderr,
        )
    for name in names:
        print(name)
