"""Get parameter."""

from argparse import Namespace

from .. import graph, parameters
from ..parsing import CommandError, Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 param get`."""
    parameters.add_arguments(parser)
    parser.add_argument("node_name", help="Name of the node (e.g. '/talker')")
    parser.add_argument("parameter_name", help="Name of the parameter")
    parser.add_argument("--hide-type", action="store_true", help="Print the value without its type")
    parameters.add_timeout(parser)


def main(args: Namespace) -> None:
    """Print the value of a parameter; raises CommandError if it is not set."""
    with graph.graph(args) as node:
        (value,) = parameters.client(node, args).values([args.parameter_name]) or [None]
    if value is None or value.type == 0:
        raise CommandError("Parameter not set")
    words = parameters.TYPES[value.type][2]
    print(*([] if args.hide_type else [words]), parameters.plain(value))
