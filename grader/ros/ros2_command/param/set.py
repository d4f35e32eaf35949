"""Set parameter."""

import sys
from argparse import Namespace

from .. import graph, parameters
from ..parsing import Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 param set`."""
    parameters.add_arguments(parser)
    parser.add_argument("node_name", help="Name of the node (e.g. '/talker')")
    parser.add_argument("parameter_name", help="Name of the parameter")
    parser.add_argument("value", help="Value, as YAML (5, 1.5, true, text, [1, 2])")
    parameters.add_timeout(parser)


def main(args: Namespace) -> None:
    """Set the parameter and print whether the node took it (the status is 0 if it did not)."""
    with graph.graph(args) as node:
        client = parameters.client(node, args)
        (result,) = client.set([parameters.from_text(args.parameter_name, args.value)])
    reason = f": {result.reason}" if result.reason else ""
    if result.successful:
        print(f"Set parameter successful{reason}")
    else:
        print(f"Setting parameter failed{reason}", file=sys.stderr)
