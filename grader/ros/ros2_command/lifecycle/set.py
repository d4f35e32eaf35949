"""Trigger lifecycle state transition."""

import sys
from argparse import Namespace

from .. import graph, managed_nodes
from ..parsing import Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 lifecycle set`."""
    graph.add_arguments(parser)
    managed_nodes.add_name(parser)
    parser.add_argument("transition", help="The lifecycle transition")


def main(args: Namespace) -> None:
    """Ask a node for a transition, by its name or number, and print whether it succeeded.

    A transition that fails gives status 0 too. Raises CommandError if the node is not there or not
    managed, or does not have the transition in its state.
    """
    with graph.graph(args) as node:
        name = managed_nodes.named(node, args)
        possible = managed_nodes.transitions(node, name)
        transition = managed_nodes.find_transition(possible, args.transition)
        if managed_nodes.change(node, name, transition):
            print("Transitioning successful")
        else:
            print("Transitioning failed", file=sys.stderr)
